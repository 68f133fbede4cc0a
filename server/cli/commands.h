#pragma once
/// @file
/// What each command does once its arguments are known. Each returns the exit status.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/result_table.h"
#include "api/sweep_table.h"
#include "server/cli/app.h"
#include "server/cli/part_file.h"
#include "server/settings.h"

namespace snapthrough::server::cli {

struct SolveOptions {
  bool csv = false;                       ///< a table in place of the result document
  std::optional<api::ResultTable> table;  ///< which one; none: that of the analysis' type
  bool show_progress = false;             ///< on the error stream
};

/// Result document, or a table of it, on `out`. "-" reads `in`. SIGINT or SIGTERM ends the analysis at its
/// next step: what was reached is written, and the status is 128 + signal.
int solve_command(const std::string& path, const Streams& streams, const SolveOptions& options);

/// Findings of a request or a sweep document on `err`, one line each; a line on `out` when there are none.
int check_command(const std::string& path, const Streams& streams);

struct SweepOptions {
  api::TableForm form = api::TableForm::json;
  int threads = 1;                     ///< points at the same time, >= 1; rows do not depend on it
  bool show_progress = false;          ///< a bar on the error stream, which the rows must not share
  std::optional<std::uint64_t> point;  ///< only the request document of this point is written
  std::string out;  ///< a part file (server/cli/part_file.h) takes the rows; empty: `out` as a table
  SweepPart part;   ///< of the points; the whole sweep by default
};

/// Rows of a sweep on `out` in design order, as they come. kNotCompleted when a point failed: its row says
/// why, the others are there. SIGINT or SIGTERM ends it after the rows that are whole: `err` says how many,
/// and the status is 128 + signal.
/// With a part file nothing is written on `out`; rows that the file has are not computed again.
int sweep_command(const std::string& path, const Streams& streams, const SweepOptions& options);

/// @brief The table of the sweep that these files are the parts of, on `out`: the bytes that sweep_command()
/// writes. When a part or a row is not there, `err` says which, nothing is written on `out`, and the status
/// is kOther.
/// @throws std::runtime_error when files do not belong together or are no parts
int merge_command(const std::vector<std::string>& paths, api::TableForm form, const Streams& streams);

/// The exit status of a table with so many failed points, which `err` tells.
int told_failed(std::uint64_t failed, std::uint64_t points, const Streams& streams);

/// Runs the service until SIGTERM or SIGINT. SIGHUP reads the keys of the configuration file again; without
/// such a file it ends the service, too.
/// @param front it answers requests; else it only works for others that share the store
int serve_command(const SettingSources& sources, bool front, const Streams& streams);

/// Copies what one store keeps to another; what is there already is left alone.
int copy_command(const std::string& source, const std::string& target, const Streams& streams);

/// Brings the schema of the store that is set up to date.
int migrate_command(const SettingSources& sources, const Streams& streams);

/// Copies the store of a service, which may be running, to a new file.
int backup_command(const std::string& store, const std::string& target, const Streams& streams);

/// Asks /livez (or /readyz) of a service on this machine; for health checks of containers.
int health_command(const std::string& address, bool ready, const Streams& streams);

}  // namespace snapthrough::server::cli
