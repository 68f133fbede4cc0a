#pragma once
/// @file
/// The sweeps that this process works on, and which of their units (unit.h) are given to whom.

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "api/sweep.h"
#include "server/environment.h"
#include "server/jobs/active_jobs.h"
#include "server/sweeps/sweep.h"

namespace snapthrough::server {

/// A sweep that is worked on. What changes belongs to the SweepScheduler.
class ActiveSweep {
 public:
  /// @param open what the store knows of it
  ActiveSweep(std::string name, api::Sweep read, OpenSweep open);

  const std::string id;
  const std::string document;  ///< that it was read from
  const api::Sweep sweep;
  const std::string owner;
  const std::string outputs;  ///< their pointers, for keys
  const bool reuse;
  /// Set when nothing of it is wanted any more.
  [[nodiscard]] std::stop_token stopped() const { return stop_.get_token(); }

 private:
  friend class SweepScheduler;
  std::vector<bool> done_;                        ///< by unit: all its points are, or it is to be given alone
  std::uint64_t cursor_ = 0;                      ///< units before it were given out
  std::deque<std::vector<std::uint64_t>> again_;  ///< units that came back, or that are to be given alone
  double seconds_per_unit_ = 0.0;                 ///< 0: not known
  std::stop_source stop_;
};

/// Units of one sweep that one worker computes.
struct Chunk {
  std::shared_ptr<ActiveSweep> sweep;
  PointClaim claim;
  std::vector<std::uint64_t> units;  ///< their numbers

  /// The points of its units.
  [[nodiscard]] std::vector<std::uint64_t> points() const;
};

/// @brief Gives the units of several sweeps out, in turn. Thread-safe.
///
/// What a unit comes to does not depend on it: each is computed alone.
class SweepScheduler {
 public:
  /// So many sweeps are worked on in turn.
  static constexpr std::size_t kMost = 8;

  /// False when it is there already.
  bool add(std::shared_ptr<ActiveSweep> sweep);
  [[nodiscard]] bool has(const std::string& id) const;
  [[nodiscard]] bool has_room() const;
  /// Whether units are left to give.
  [[nodiscard]] bool has_units() const { return available_; }
  [[nodiscard]] std::size_t count() const;

  /// Units of the next sweep in turn, as many as take about a tenth of a second; without a claim.
  std::optional<Chunk> take();
  /// Ends a chunk that take() gave. @param rest units that were not computed
  /// @param seconds that the others took
  void give_back(const Chunk& chunk, std::vector<std::uint64_t> rest, double seconds);
  /// Nothing of it is wanted any more: those who work on it are asked to stop.
  void remove(const std::string& id);
  /// The same for this one only, not for one of that id that was added since (dismissed and tried again).
  void remove(const std::shared_ptr<ActiveSweep>& sweep);

  /// A chunk is worked on for as long as this exists; upkeep sees when a unit takes too long.
  class Watch {
   public:
    Watch(SweepScheduler& scheduler, Time since);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    Watch(Watch&&) = delete;
    Watch& operator=(Watch&&) = delete;
    /// The next unit begins.
    void begin(Time since);
    void stop(StopReason reason);
    [[nodiscard]] StopReason reason() const;
    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

   private:
    friend class SweepScheduler;
    SweepScheduler& scheduler_;
    Time since_;
    StopReason reason_ = StopReason::none;
    std::stop_source stop_;
  };
  /// Stops units that began before that time.
  void stop_older(Time since);

 private:
  template <class Is>
  void remove_if(Is is);
  static std::vector<std::uint64_t> next_units(ActiveSweep& sweep);
  static std::size_t most_units(const ActiveSweep& sweep);
  static bool has_more(ActiveSweep& sweep);
  void look();

  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<ActiveSweep>> sweeps_;  ///< the first is the next in turn
  std::vector<Watch*> watches_;
  std::atomic<bool> available_ = false;
};

}  // namespace snapthrough::server
