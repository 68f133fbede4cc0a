#pragma once
/// @file
/// Verbs of a store of sweeps. Thread safety, durability, atomicity and time: see Store (store/store.h).

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
  std::optional<ListPlace> next;  ///< start of the next page; empty: this is the last page
};

/// Outcome of dismissing or retrying a sweep: its state before (empty: there is no such sweep), and whether
/// it changed.
struct SweepChange {
  std::optional<JobState> before;
  bool changed = false;
};

/// Stored sweeps and the rows of their points.
class SweepStore {
 public:
  SweepStore() = default;
  SweepStore(const SweepStore&) = delete;
  SweepStore& operator=(const SweepStore&) = delete;
  SweepStore(SweepStore&&) = delete;
  SweepStore& operator=(SweepStore&&) = delete;
  virtual ~SweepStore() = default;

  /// Adds a sweep in state accepted unless its idempotency key is known. `waiting_quota`, `storage_quota` or
  /// `rate_quota` when the sweep would exceed a quota of its owner.
  virtual StatusOr<Submitted> submit(const NewSweep& sweep) = 0;
  /// Outcome of an earlier submission of the owner with the key; empty for a new key.
  virtual StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) = 0;
  /// Idempotency keys that stand for a sweep, sorted; none when there is no such sweep.
  virtual StatusOr<std::vector<UsedKey>> keys(std::string_view id) = 0;
  /// Lets a key stand for a sweep unless the owner has used the key.
  virtual Status add_key(std::string_view id, const UsedKey& key) = 0;
  /// Number of accepted and running sweeps.
  virtual StatusOr<std::int64_t> unfinished() = 0;
  /// Ids of sweeps with items that nobody has: the oldest of each owner, then the second of each, and so on.
  virtual StatusOr<std::vector<std::string>> with_items() = 0;
  /// An accepted or running sweep, or empty.
  virtual StatusOr<std::optional<OpenSweep>> open(std::string_view id) = 0;

  /// @brief Gives at most `most` items that nobody has to the caller, and makes the sweep running. Items
  /// during which a process died come last, and fewer at a time (most_after_crashes()). Empty when no item is
  /// free; `conflict` when the sweep is neither accepted nor running. The claim survives the death of the
  /// process, not that of the machine. Points of the items may have rows: retry() joins items that failed.
  virtual StatusOr<std::optional<ItemClaim>> claim(std::string_view id, std::uint64_t most,
                                                   const Lease& lease, Time now) = 0;
  /// Renews the leases of claims that hold; returns the numbers of the others.
  virtual StatusOr<std::vector<std::int64_t>> renew(const std::vector<ItemClaim>& claims, Time until,
                                                    Time now) = 0;
  /// @brief Stores rows and ends the claim; items of which a point has no row are given out again. A point
  /// that has a row keeps it. The sweep ends when all points have a row. `conflict`, and nothing is stored,
  /// when the claim does not hold or the sweep is not running.
  /// @param rows rows of points of the items
  /// @param usage of computing them; counts for the owner (Store::ledger())
  virtual StatusOr<SweepRecord> put(const ItemClaim& claim, const std::vector<PointRow>& rows,
                                    const WorkUsage& usage, Time now) = 0;
  StatusOr<SweepRecord> put(const ItemClaim& claim, const std::vector<PointRow>& rows, Time now) {
    return put(claim, rows, {}, now);
  }
  /// @brief Ends every claim, since its process is known to be gone (see Store::recover()): items are given
  /// out again; an item that was claimed alone at crash number `max_crashes` gets rows with the code
  /// "crashed".
  /// @return number of items that are given out again
  virtual StatusOr<std::int64_t> recover(int max_crashes, Time now) = 0;
  /// Ends claims whose lease has run out, as recover() does; leases of `worker` do not count as crashes.
  virtual StatusOr<std::int64_t> rescue(std::string_view worker, int max_crashes, Time now) = 0;

  /// Dismisses an accepted or running sweep; its rows stay.
  virtual StatusOr<SweepChange> dismiss(std::string_view id, Time now) = 0;
  /// Removes the failed rows of a failed or dismissed sweep and makes the sweep accepted. `waiting_quota` or
  /// `rate_quota` when its points would exceed a quota of its owner.
  virtual StatusOr<SweepChange> retry(std::string_view id, const Quotas& quotas, Time now) = 0;
  /// Hides the sweep from every other verb; purge() frees its space. False when there is none.
  /// @param noted see Store::remove()
  virtual StatusOr<bool> remove(std::string_view id, std::optional<Time> noted) = 0;
  StatusOr<bool> remove(std::string_view id) { return remove(id, std::nullopt); }
  /// Removes sweeps that ended longer than `age` ago; returns their number.
  virtual StatusOr<int> retire(std::chrono::seconds age, Time now) = 0;
  /// Frees the space of at most `most` rows of removed sweeps; true when there may be more.
  virtual StatusOr<bool> purge(int most) = 0;
  /// Removes idempotency keys that were first used longer than `age` ago.
  virtual Status forget_keys(std::chrono::seconds age, Time now) = 0;

  virtual StatusOr<std::optional<SweepRecord>> get(std::string_view id) = 0;
  virtual StatusOr<SweepPage> list(const ListQuery& query) = 0;
  /// The sweep document; empty when there is no such sweep.
  virtual StatusOr<std::optional<std::string>> document(std::string_view id) = 0;
  /// Calls `use` with the stored rows in the order of points for as long as `use` returns true.
  virtual Status each_row(std::string_view id, const PointQuery& query,
                          const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) = 0;
  /// Outputs of solved points with these keys, in the order of the keys; empty where there is none.
  virtual StatusOr<std::vector<std::optional<std::string>>> find_outputs(
      const std::vector<std::string>& keys) = 0;
};

}  // namespace snapthrough::server
