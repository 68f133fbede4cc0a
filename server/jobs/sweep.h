#pragma once
/// @file
/// Sweeps as data: what is handed in, stored, claimed and returned.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/point_outcome.h"
#include "server/jobs/job.h"
#include "server/jobs/sweep_state.h"

namespace snapthrough::server {

/// @brief A sweep without its document and rows.
///
/// A sweep is accepted until a worker takes its first items, running until every point has its row, and then
/// successful, or failed if a row has an error. A failed or dismissed sweep that is tried again is accepted
/// (sweep_state.h).
struct SweepRecord {
  std::string id;
  JobState state = JobState::accepted;
  std::string owner;  ///< see Job
  std::string title;
  std::string analysis_type;    ///< type in its document; parameters may change the type of points
  std::int64_t points = 0;      ///< points of the design
  std::int64_t successful = 0;  ///< rows with outputs
  std::int64_t failed = 0;      ///< rows with an error
  std::int64_t reused = 0;      ///< successful rows that were taken from another sweep
  Time created;
  std::optional<Time> started;
  std::optional<Time> finished;  ///< set exactly in a final state
  Annotations annotations;
  std::string request_sha256;      ///< digest of the sweep document, see Job
  std::string program;             ///< see Job; of several programs, one of them
  std::optional<WorkUsage> usage;  ///< sum over its points; empty: nothing was computed

  [[nodiscard]] std::int64_t done() const { return successful + failed; }
};

/// A sweep that is submitted to a store.
struct NewSweep {
  std::string id;  ///< from new_id()
  std::string title = {};
  std::string document;  ///< sweep document as received, JSON text
  std::int64_t points = 0;
  Time created;
  std::string owner = {};
  std::int64_t item_points = 1;  ///< points of each item (worker/sweep_item.h); divides `points`
  std::optional<IdempotencyKey> idempotency = {};
  bool reuse = true;  ///< rows of other sweeps of the owner may be used
  std::string analysis_type = {};
  Annotations annotations = {};
  Quotas quotas = {};  ///< bounds of the owner
  std::string request_sha256 = {};
};

/// Row of the table of a sweep.
struct PointRow {
  std::uint64_t point = 0;
  api::PointOutcome outcome;
  std::string key = {};  ///< see point_key(); empty: the row is not reused
  bool reused = false;
};

/// Part of an unfinished sweep that a worker needs.
struct OpenSweep {
  std::string document;
  std::string owner;
  bool reuse = true;
};

/// Consecutive items of a sweep.
struct ItemRun {
  std::uint64_t first = 0;  ///< number of the first item, counted from 0
  std::uint64_t count = 0;

  bool operator==(const ItemRun&) const = default;
};

/// Claim of a worker on items. Stores refuse rows under a claim whose lease has run out.
struct ItemClaim {
  std::int64_t number = 0;  ///< never used again
  std::string sweep;
  ItemRun items;
};

/// Selection of rows of the table of a sweep.
struct PointQuery {
  std::uint64_t first = 0;
  std::uint64_t count = UINT64_MAX;  ///< points from `first` on, with a row or not
  std::optional<bool> failed;        ///< only rows with (true) or without (false) an error
};

}  // namespace snapthrough::server
