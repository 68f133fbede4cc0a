#pragma once
/// @file
/// The commands that use a service: submit, wait, fetch. Each function returns the exit status.

#include <cstdint>
#include <optional>
#include <string>

#include "server/cli/streams.h"

namespace snapthrough::server::cli {

/// Address of the service and options of requests.
struct ServiceOptions {
  std::string url = "http://127.0.0.1:8080";
  std::string key_file;      ///< file whose first line is the key; empty: no key
  std::string certificates;  ///< PEM file to verify https; empty: certificates of the system
  int patience_s = 60;       ///< seconds for which a request is repeated, >= 0
};

struct SubmitOptions {
  std::string label;            ///< label of the job; empty: none
  std::string idempotency_key;  ///< Idempotency-Key; empty: a random one
};

/// @brief Submits a request or a sweep, and writes its id to `out`.
///
/// Nothing is written before the service acknowledges. Findings of an invalid document are reported as by
/// check_command(), and the status is kWrongRequest.
/// @param path file of the document; "-" reads `in`
int submit_command(const std::string& path, const ServiceOptions& service, const SubmitOptions& options,
                   const Streams& streams);

struct WaitOptions {
  std::optional<double> timeout_s;  ///< longest wait in seconds; nullopt: no limit
  bool show_progress = false;       ///< show progress on the error stream
};

/// @brief Waits for the end of a job or a sweep, and writes its last status to `out`.
///
/// Returns kDone after success, kNotCompleted when it failed, was dismissed or has rows with an error,
/// kUnfinished after `timeout_s`. SIGINT or SIGTERM ends the waiting, not the job.
int wait_command(const std::string& id, const ServiceOptions& service, const WaitOptions& options,
                 const Streams& streams);

struct FetchOptions {
  bool csv = false;
  bool ndjson = false;  ///< write NDJSON; only for sweeps
  std::string table;    ///< CSV table of a job; empty: default of the analysis type
  std::string output;   ///< file to write; empty: `out`
};

/// @brief Writes the result of a job, or the table of a sweep.
///
/// For a failed job the part that was computed is written, and the status is kNotCompleted, as for a sweep
/// with failed points. kUnfinished when a job has not ended (nothing is written) or rows of a sweep are
/// missing (the others are written). A file gets its name when it is complete.
int fetch_command(const std::string& id, const ServiceOptions& service, const FetchOptions& options,
                  const Streams& streams);

}  // namespace snapthrough::server::cli
