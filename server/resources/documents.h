#pragma once
/// @file
/// JSON documents of the interface other than requests and results: job status, lists, problems.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/message.h"
#include "server/store/store.h"
#include "solver/check/check.h"
#include "solver/solve.h"

namespace snapthrough::server::http {

/// An error response (RFC 9457). `kind` determines its type: urn:snapthrough:problem:<kind>.
struct Problem {
  int status = 500;
  std::string kind;
  std::string title;
  std::string detail;
  std::vector<Finding> errors;  ///< findings about a document
  std::string code;             ///< code of a failed analysis
  std::string reached;          ///< result document (JSON text) that a failed analysis reached
};

/// Returns the path of a job: "/v1/jobs/<id>".
[[nodiscard]] std::string job_path(std::string_view id);

/// Returns the status document of a job, with its progress if known.
[[nodiscard]] std::string job_status_document(const Job& job, const std::optional<Progress>& progress);

/// Returns a page of jobs; `next` is the path of the next page, "" on the last one.
[[nodiscard]] std::string job_list_document(const JobPage& page, std::string_view next);

/// Returns the path of a sweep: "/v1/sweeps/<id>".
[[nodiscard]] std::string sweep_path(std::string_view id);

/// Returns the numbers of successful, failed, reused (among the successful) and remaining points.
[[nodiscard]] nlohmann::ordered_json sweep_counts(const SweepRecord& sweep);

[[nodiscard]] std::string sweep_status_document(const SweepRecord& sweep);

/// Returns a page of sweeps; `next` is the path of the next page, "" on the last one.
[[nodiscard]] std::string sweep_list_document(const SweepPage& page, std::string_view next);

/// Returns the links of a page of a list: that to the next page, unless `next` is "".
[[nodiscard]] nlohmann::ordered_json page_links(std::string_view next);

/// Returns application/problem+json; for a request of the Hops protocol a document of that protocol, which
/// can only hold sentences.
[[nodiscard]] Response problem_response(const Problem& problem, const Request& request);

}  // namespace snapthrough::server::http
