#pragma once
/// @file
/// What the service needs from a database for sweeps. Same promises as Store (server/store/store.h).

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/sweep.h"
#include "server/status.h"
#include "server/store/list_query.h"

namespace snapthrough::server {

/// One page of sweeps, newest first.
struct SweepPage {
  std::vector<SweepRecord> sweeps;
  std::optional<ListPlace> next;  ///< where the next page starts; empty: this is the last
};

/// What was asked of a sweep: what it was before (empty: there is none), and whether it is done now.
struct SweepChange {
  std::optional<JobState> before;
  bool changed = false;
};

/// @brief The stored sweeps and their points. Thread-safe; every verb happens wholly or not at all.
class SweepStore {
 public:
  SweepStore() = default;
  SweepStore(const SweepStore&) = delete;
  SweepStore& operator=(const SweepStore&) = delete;
  SweepStore(SweepStore&&) = delete;
  SweepStore& operator=(SweepStore&&) = delete;
  virtual ~SweepStore() = default;

  /// Adds a sweep in state accepted, unless its idempotency key is known; fails as Store::submit() does when
  /// its owner would have more than its quotas.
  virtual StatusOr<Submitted> submit(const NewSweep& sweep) = 0;
  /// What is known of an idempotency key of an owner; empty when it is new.
  virtual StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) = 0;
  /// How many sweeps are accepted or running.
  virtual StatusOr<std::int64_t> unfinished() = 0;
  /// Ids of sweeps of which there are units that nobody has: the oldest of each owner, the second of each,
  /// and so on.
  virtual StatusOr<std::vector<std::string>> with_units() = 0;
  /// What a worker needs to go on with an accepted or running sweep; empty when there is none.
  virtual StatusOr<std::optional<OpenSweep>> open(std::string_view id) = 0;

  /// @brief Gives units that nobody has to the caller, at most `most`, and makes the sweep running. Units
  /// during which a process died come last, and fewer at a time (server/store/crashes.h). Empty when others
  /// have all that is left; `conflict` when the sweep is neither accepted nor running. It survives the death
  /// of the process, not that of the machine.
  virtual StatusOr<std::optional<UnitClaim>> claim(std::string_view id, std::uint64_t most,
                                                   const Lease& lease, Time now) = 0;
  /// Renews the leases of claims that still hold; the numbers of those that don't.
  virtual StatusOr<std::vector<std::int64_t>> renew(const std::vector<UnitClaim>& claims, Time until,
                                                    Time now) = 0;
  /// @brief Stores rows of a claim and ends it: units without rows are given out again. Ends the sweep when
  /// all points have a row. `conflict`, and nothing is stored, when the claim does not hold any more or the
  /// sweep is not running. A point that has a row keeps it.
  /// @param rows of all points of some of its units
  virtual StatusOr<SweepRecord> put(const UnitClaim& claim, const std::vector<PointRow>& rows, Time now) = 0;
  /// Deals with the claims of a process that is known to be gone (see Store::recover()): their units are
  /// given out again, or a unit's points get rows with the code "crashed" when that happened `max_crashes`
  /// times, the last time with it alone.
  /// @return how many units are given out again
  virtual StatusOr<std::int64_t> recover(int max_crashes, Time now) = 0;
  /// The same for claims whose lease has run out, see Store::rescue().
  virtual StatusOr<std::int64_t> rescue(std::string_view worker, int max_crashes, Time now) = 0;

  /// Makes an accepted or running sweep dismissed; its rows stay.
  virtual StatusOr<SweepChange> dismiss(std::string_view id, Time now) = 0;
  /// Takes the failed rows out of a failed or dismissed sweep and makes it accepted, unless its owner would
  /// have more points waiting, or of this hour, than its quota: `waiting_quota`, `rate_quota`.
  virtual StatusOr<SweepChange> retry(std::string_view id, const Quotas& quotas, Time now) = 0;
  /// Nobody shall find the sweep any more; purge() gives its space back. False when there is none.
  virtual StatusOr<bool> remove(std::string_view id) = 0;
  /// Removes sweeps that ended longer ago than that; how many.
  virtual StatusOr<int> retire(std::chrono::seconds age, Time now) = 0;
  /// Gives back the space of at most `most` rows of removed sweeps; true when there may be more.
  virtual StatusOr<bool> purge(int most) = 0;
  /// Forgets idempotency keys that were first used longer ago than that.
  virtual Status forget_keys(std::chrono::seconds age, Time now) = 0;

  virtual StatusOr<std::optional<SweepRecord>> get(std::string_view id) = 0;
  virtual StatusOr<SweepPage> list(const ListQuery& query) = 0;
  /// The sweep document; empty when there is no such sweep.
  virtual StatusOr<std::optional<std::string>> document(std::string_view id) = 0;
  /// Calls it with each row that is there, in the order of points, for as long as it returns true.
  virtual Status each_row(std::string_view id, const PointQuery& query,
                          const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) = 0;
  /// Outputs of points with these keys that were solved before; empty where there is none.
  virtual StatusOr<std::vector<std::optional<std::string>>> find_outputs(
      const std::vector<std::string>& keys) = 0;
};

}  // namespace snapthrough::server
