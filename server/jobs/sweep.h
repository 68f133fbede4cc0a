#pragma once
/// @file
/// A sweep and what is kept of it. Plain data.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/sweep.h"
#include "server/jobs/job.h"
#include "server/jobs/sweep_state.h"

namespace snapthrough::server {

/// @brief What is known of a sweep without its document and rows.
///
/// A sweep is accepted until a worker takes its first points, running until every point has its row, and then
/// successful, or failed when some of its points are. A failed or dismissed sweep that is tried again is
/// accepted.
struct SweepRecord {
  std::string id;
  JobState state = JobState::accepted;
  std::string owner;  ///< as of a job
  std::string title;
  std::string analysis_type;    ///< of its document, whatever its parameters make of it
  std::int64_t points = 0;      ///< of the design
  std::int64_t successful = 0;  ///< rows with outputs
  std::int64_t failed = 0;      ///< rows with an error
  std::int64_t reused = 0;      ///< of the successful ones: taken from another sweep
  Time created;
  std::optional<Time> started;
  std::optional<Time> finished;  ///< exactly in a final state
  Annotations annotations;

  [[nodiscard]] std::int64_t done() const { return successful + failed; }
};

/// A sweep as it is handed in.
struct NewSweep {
  std::string id;  ///< from new_id()
  std::string title = {};
  std::string document;  ///< JSON text as received
  std::int64_t points = 0;
  Time created;
  std::string owner = {};
  std::int64_t unit_points = 1;  ///< points of each unit (server/worker/unit.h); divides `points`
  std::optional<IdempotencyKey> idempotency = {};
  bool reuse = true;  ///< rows of other sweeps of the same owner will do
  std::string analysis_type = {};
  Annotations annotations = {};
  Quotas quotas = {};  ///< of the owner
};

/// A row of a sweep's table.
struct PointRow {
  std::uint64_t point = 0;
  api::PointOutcome outcome;
  std::string key = {};  ///< equal for points with equal outputs; empty: not reused
  bool reused = false;
};

/// What a worker needs of a sweep to go on with it.
struct OpenSweep {
  std::string document;
  std::string owner;
  bool reuse = true;
};

/// Units of a sweep, one after the other.
struct UnitRun {
  std::uint64_t first = 0;  ///< number of the first unit, counted from 0
  std::uint64_t count = 0;

  bool operator==(const UnitRun&) const = default;
};

/// Units that a worker has until its lease runs out, and what proves that it still does.
struct UnitClaim {
  std::int64_t number = 0;  ///< never used again
  std::string sweep;
  UnitRun units;
};

/// What of a sweep's table to read.
struct PointQuery {
  std::uint64_t first = 0;
  std::uint64_t count = UINT64_MAX;  ///< points from there on, with a row or not
  std::optional<bool> failed;        ///< only these
};

}  // namespace snapthrough::server
