#pragma once
/// @file
/// The sweeps that this process works on, and whose turn it is. Which units (unit.h) a worker gets is the
/// store's to say.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <vector>

#include "api/sweep.h"
#include "server/environment.h"
#include "server/jobs/active_jobs.h"
#include "server/jobs/sweep.h"

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
  bool exhausted_ = false;         ///< others have all units that are left, as far as is known
  std::uint64_t changes_ = 0;      ///< how often units may have come back
  std::uint64_t served_ = 0;       ///< when it had its last turn, in turns
  double seconds_per_unit_ = 0.0;  ///< 0: not known
  std::stop_source stop_;
};

/// A sweep whose turn it is.
struct SweepTurn {
  std::shared_ptr<ActiveSweep> sweep;
  std::uint64_t most = 1;     ///< units that a worker computes at a time
  std::uint64_t changes = 0;  ///< for exhausted()
};

/// Units of one sweep that one worker computes.
struct Chunk {
  std::shared_ptr<ActiveSweep> sweep;
  UnitClaim claim;
  double claim_seconds = 0.0;  ///< that the store took to give them
};

/// @brief Gives turns to several sweeps: owners take turns, and of each owner its sweeps. Thread-safe.
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
  /// Whether units may be left to take.
  [[nodiscard]] bool has_units() const { return available_; }
  [[nodiscard]] std::size_t count() const;

  /// The next sweep in turn of which units may be left, and as many as take about so long.
  std::optional<SweepTurn> next(double seconds);
  /// The store had no units for that turn.
  void exhausted(const SweepTurn& turn);
  /// Units of any sweep may have come back; sweeps of which none were left, and nobody here has any, leave.
  void refresh();
  /// @brief How long a worker computes before it stores rows and looks for jobs: a tenth of a second, up to a
  /// second where the store takes more than a twentieth of that to give units out and to take rows: so
  /// workers hardly wait for the store, and one that many work on is asked less often.
  [[nodiscard]] double chunk_seconds() const;
  /// What it took the store to give out the units of a chunk and to take its rows.
  void store_took(double seconds);
  /// Ends a chunk. @param computed units, in that many seconds
  void give_back(const Chunk& chunk, std::uint64_t computed, double seconds);
  /// Nothing of it is wanted any more: those who work on it are asked to stop.
  void remove(const std::string& id);
  /// The same for this one only, not for one of that id that was added since (dismissed and tried again).
  void remove(const std::shared_ptr<ActiveSweep>& sweep);

  /// A chunk is worked on for as long as this exists; upkeep sees when a unit takes too long, and renews the
  /// lease.
  class Watch {
   public:
    Watch(SweepScheduler& scheduler, const UnitClaim& claim, Time since);
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
    const UnitClaim& claim_;
    const Time held_since_;
    Time since_;
    StopReason reason_ = StopReason::none;
    std::stop_source stop_;
  };
  /// Stops units that began before that time.
  void stop_older(Time since);
  /// Stops those who work on that claim.
  void stop_claim(std::int64_t number, StopReason reason);
  /// The claims that are held since before that time.
  [[nodiscard]] std::vector<UnitClaim> older(Time since) const;

 private:
  template <class Is>
  void remove_if(Is is);
  template <class Is>
  void stop_if(Is is, StopReason reason);
  static std::uint64_t most_units(const ActiveSweep& sweep, double seconds);
  [[nodiscard]] std::uint64_t served(const std::string& owner) const;
  void look();

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<ActiveSweep>> sweeps_;       ///< the oldest first
  std::unordered_map<std::string, std::uint64_t> served_;  ///< by owner: its last turn
  std::uint64_t turns_ = 0;
  std::vector<Watch*> watches_;
  std::atomic<bool> available_ = false;
  std::atomic<double> store_seconds_ = 0.0;  ///< of one chunk, about
};

}  // namespace snapthrough::server
