#pragma once
/// @file
/// The commands that leave the work to a service: submit, wait, fetch. Each returns the exit status.

#include <cstdint>
#include <optional>
#include <string>

#include "server/cli/app.h"

namespace snapthrough::server::cli {

/// Where the service is and how it is asked.
struct ServiceOptions {
  std::string url = "http://127.0.0.1:8080";
  std::string key_file;      ///< the key is its first line; empty: no key
  std::string certificates;  ///< PEM file to verify https with; empty: what the system trusts
  int patience_s = 60;       ///< how long a request is repeated, >= 0
};

struct SubmitOptions {
  std::string label;            ///< empty: none
  std::string idempotency_key;  ///< empty: a new one
};

/// @brief Hands in a request or a sweep, and writes the id that the service gave it on `out`.
///
/// Nothing is written before the service has acknowledged. A document that is wrong is told as
/// check_command() tells it, and the status is kWrongRequest.
/// @param path of the document; "-" reads `in`
int submit_command(const std::string& path, const ServiceOptions& service, const SubmitOptions& options,
                   const Streams& streams);

struct WaitOptions {
  std::optional<double> timeout_s;  ///< none: until it ends
  bool show_progress = false;       ///< on the error stream
};

/// @brief Waits for the end of a job or a sweep, and writes its last status on `out`.
///
/// kDone when it is successful, kNotCompleted when it failed, was dismissed or has rows with an error,
/// kUnfinished when `timeout_s` is over. SIGINT or SIGTERM ends the waiting, not the job.
int wait_command(const std::string& id, const ServiceOptions& service, const WaitOptions& options,
                 const Streams& streams);

struct FetchOptions {
  bool csv = false;
  bool ndjson = false;  ///< of a sweep only
  std::string table;    ///< of a job, which one, as CSV; empty: that of the analysis' type
  std::string output;   ///< file to write; empty: `out`
};

/// @brief Writes the result of a job, or the table of a sweep.
///
/// Of a failed job what was reached is written, and the status is kNotCompleted; likewise for a sweep with
/// rows that have an error. kUnfinished when a job has not ended (nothing is written) or a sweep has points
/// without a row (the others are written). A file gets its name when everything is in it.
int fetch_command(const std::string& id, const ServiceOptions& service, const FetchOptions& options,
                  const Streams& streams);

}  // namespace snapthrough::server::cli
