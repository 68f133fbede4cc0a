#pragma once
/// @file
/// Scheduler of the sweeps that this process works on. The store decides which items (worker/sweep_item.h) a
/// worker gets.

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

/// A sweep that this process works on. The SweepScheduler guards the private members.
class ActiveSweep {
 public:
  /// @param open the stored sweep that `read` was read from
  ActiveSweep(std::string name, api::Sweep read, OpenSweep open);

  const std::string id;
  const std::string document;  ///< text that `sweep` was read from
  const api::Sweep sweep;
  const std::string owner;
  const std::string outputs;  ///< pointers of the outputs, for keys of points
  const bool reuse;
  /// Requested when the sweep was dismissed, removed or has ended.
  [[nodiscard]] std::stop_token stopped() const { return stop_.get_token(); }

 private:
  friend class SweepScheduler;
  bool aside_ = false;             ///< waits until it is among those that the owners' rotation gives turns
  bool exhausted_ = false;         ///< at the last look other workers had all items that are left
  std::uint64_t changes_ = 0;      ///< number of times that items may have come back
  std::uint64_t served_ = 0;       ///< number of its last turn
  double seconds_per_item_ = 0.0;  ///< mean of recent chunks; 0: not known
  std::stop_source stop_;
};

/// Turn of a sweep.
struct SweepTurn {
  std::shared_ptr<ActiveSweep> sweep;
  std::uint64_t most = 1;     ///< items that the worker should claim, at most
  std::uint64_t changes = 0;  ///< changes of the sweep at this turn, see exhausted()
};

/// Items of one sweep that one worker computes before it stores their rows.
struct Chunk {
  std::shared_ptr<ActiveSweep> sweep;
  ItemClaim claim;
  double claim_seconds = 0.0;  ///< time that the claim took in the store
};

/// @brief Gives turns to sweeps: owners take turns, and the sweeps of an owner take turns. Thread-safe.
///
/// Results do not depend on the order: each item is computed alone.
class SweepScheduler {
 public:
  /// Most sweeps with turns at a time.
  static constexpr std::size_t kMost = 8;

  /// Adds a sweep; returns false when a sweep of that id is there.
  bool add(std::shared_ptr<ActiveSweep> sweep);
  [[nodiscard]] bool has(const std::string& id) const;
  /// Gives turns to these sweeps only; the items that workers have of others go on.
  void give_turns_to(const std::vector<std::string>& ids);
  /// Whether a sweep may have items left.
  [[nodiscard]] bool has_items() const { return available_; }
  [[nodiscard]] std::size_t count() const;

  /// @brief Turn of the next sweep that may have items left, for a chunk of about `seconds`.
  /// @param owners whose sweeps may be taken; idle are those of whose sweeps no worker of this process has a
  /// chunk
  std::optional<SweepTurn> next(double seconds, const OwnersInTurn& owners = {});
  /// Notes that the store had no items for that turn.
  void exhausted(const SweepTurn& turn);
  /// Notes that items of any sweep may have come back; removes exhausted sweeps without a worker in this
  /// process.
  void refresh();
  /// @brief Seconds that a worker computes before it stores rows and looks for jobs: 0.1, up to 1 where claim
  /// and rows take the store more than a twentieth of that, so that workers hardly wait for a busy store.
  [[nodiscard]] double chunk_seconds() const;
  /// Notes how long the store took for the claim and the rows of a chunk.
  void store_took(double seconds);
  /// Ends a chunk that took `seconds`. @param done items of the chunk that need no more work
  void give_back(const Chunk& chunk, std::uint64_t done, double seconds);
  /// Removes a sweep and asks its workers in this process to stop.
  void remove(const std::string& id);
  /// Removes this object only, not a later one with its id (a sweep that was dismissed and tried again).
  void remove(const std::shared_ptr<ActiveSweep>& sweep);

  /// Registers a chunk in work for as long as the watch exists, so that its lease is renewed and an item that
  /// takes too long is stopped.
  class Watch {
   public:
    Watch(SweepScheduler& scheduler, const ItemClaim& claim, Time since);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    Watch(Watch&&) = delete;
    Watch& operator=(Watch&&) = delete;
    /// Notes when the next item began.
    void begin(Time since);
    void stop(StopReason reason);
    [[nodiscard]] StopReason reason() const;
    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

   private:
    friend class SweepScheduler;
    SweepScheduler& scheduler_;
    const ItemClaim& claim_;
    const Time held_since_;
    Time since_;
    StopReason reason_ = StopReason::none;
    std::stop_source stop_;
  };
  /// Stops chunks whose current item began before `since`.
  void stop_older(Time since);
  /// Stops the chunk of a claim.
  void stop_claim(std::int64_t number, StopReason reason);
  /// Claims that are held since `since` or longer.
  [[nodiscard]] std::vector<ItemClaim> older(Time since) const;

 private:
  template <class Is>
  void remove_if(Is is);
  template <class Is>
  void stop_if(Is is, StopReason reason);
  static std::uint64_t most_items(const ActiveSweep& sweep, double seconds);
  [[nodiscard]] std::ptrdiff_t chunks_of(const std::string& owner) const;
  [[nodiscard]] std::uint64_t served(const std::string& owner) const;
  void look();

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<ActiveSweep>> sweeps_;       ///< in the order of add()
  std::unordered_map<std::string, std::uint64_t> served_;  ///< number of the last turn of each owner
  std::uint64_t turns_ = 0;
  std::vector<Watch*> watches_;
  std::atomic<bool> available_ = false;
  std::atomic<double> store_seconds_ = 0.0;  ///< mean time that the store takes for a chunk
};

}  // namespace snapthrough::server
