#pragma once
/// @file
/// The commands, called with parsed arguments. Each function returns the exit status.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/result_table.h"
#include "api/sweep_table.h"
#include "server/cli/part_file.h"
#include "server/cli/streams.h"
#include "server/settings.h"

namespace CLI {
class App;
}

namespace snapthrough::server::cli {

/// Returns all commands with options, help and defaults, as run() parses them, for manual pages and
/// completion.
[[nodiscard]] std::shared_ptr<const CLI::App> described_app();

struct SolveOptions {
  bool csv = false;                       ///< write a table instead of the result
  std::optional<api::ResultTable> table;  ///< the table; nullopt: default of the analysis type
  bool show_progress = false;             ///< show progress on the error stream
};

/// Solves a request ("-": from `in`) and writes the result or a table to `out`. SIGINT or SIGTERM ends the
/// analysis at its next step; the part that was computed is written, and the status is 128 + signal.
int solve_command(const std::string& path, const Streams& streams, const SolveOptions& options);

/// Checks a request or a sweep: findings go to `err`, one a line; without findings `out` gets one line.
int check_command(const std::string& path, const Streams& streams);

/// Solves a request again and compares with a stored result, number by number; what the program took and what
/// it is are not compared. kNotCompleted when a number differs by more than the tolerance, or anything else
/// differs; kWrongRequest when the result names another request.
/// @param tolerance largest relative difference, >= 0
int recompute_command(const std::string& request_path, const std::string& result_path, double tolerance,
                      const Streams& streams);

struct SweepOptions {
  api::TableForm form = api::TableForm::json;
  int threads = 1;                     ///< number of points solved at a time, >= 1; does not change rows
  bool show_progress = false;          ///< show a bar on the error stream; rows must not go there
  std::optional<std::uint64_t> point;  ///< write only the request of this point
  std::string out;  ///< part file for the rows (server/cli/part_file.h); empty: a table on `out`
  SweepPart part;   ///< part of the sweep to solve; default: all
};

/// Solves a sweep and writes its rows to `out` in design order. When a point fails, its row has the reason
/// and the status is kNotCompleted. SIGINT or SIGTERM ends the sweep after the last complete row: `err` gets
/// the number of rows, and the status is 128 + signal. With a part file nothing is written to `out`, and rows
/// of the file are not computed again.
int sweep_command(const std::string& path, const Streams& streams, const SweepOptions& options);

/// @brief Writes the table of a sweep from its part files to `out`, byte for byte as sweep_command() writes
/// it. For a missing part or row, `err` names it, nothing is written to `out`, and the status is kOther.
/// @throws std::runtime_error when a file is no part file or belongs to another sweep
int merge_command(const std::vector<std::string>& paths, api::TableForm form, const Streams& streams);

/// Reports the number of failed points, if any, on `err`; returns the exit status.
int told_failed(const api::RowCounts& counts, const Streams& streams);

/// Runs the service until SIGTERM or SIGINT. SIGHUP reloads the keys of the configuration file; without a
/// file, it ends the service, too.
/// @param front true: answer requests; false: only work on jobs of services that share the store
int serve_command(const SettingSources& sources, bool front, const Streams& streams);

/// Serves a language model by the Model Context Protocol: messages on `in` and `out`, until `in` ends.
/// @param memory largest memory of one analysis in bytes
int mcp_command(std::int64_t memory, const Streams& streams);

/// Copies the jobs and sweeps of a store to another store; existing ones in the target are not changed.
int copy_command(const std::string& source, const std::string& target, const Streams& streams);

/// Migrates the configured store to the schema of this version.
int migrate_command(const SettingSources& sources, const Streams& streams);

/// Copies the store of a service, which may be running, to a new file.
int backup_command(const std::string& store, const std::string& target, const Streams& streams);

/// Requests /livez or /readyz of a service on this machine, for health checks of containers.
int health_command(const std::string& address, bool ready, const Streams& streams);

}  // namespace snapthrough::server::cli
