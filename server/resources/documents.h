#pragma once
/// @file
/// The JSON documents of the interface other than requests and results: job status, lists, problems.

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

/// An error response (RFC 9457). `kind` names its type: urn:snapthrough:problem:<kind>.
struct Problem {
  int status = 500;
  std::string kind;
  std::string title;
  std::string detail;
  std::vector<Finding> errors;  ///< what is wrong with a document
  std::string code;             ///< of a failed analysis
  std::string reached;          ///< result document (JSON text) of what a failed analysis reached
};

/// The job's place: "/v1/jobs/<id>".
[[nodiscard]] std::string job_path(std::string_view id);

/// Status of one job, with the progress of a running one if it is known.
[[nodiscard]] std::string job_status_document(const Job& job, const std::optional<Progress>& progress);

/// A page of jobs; `next` is the path of the following page, empty on the last.
[[nodiscard]] std::string job_list_document(const JobPage& page, std::string_view next);

/// The sweep's place: "/v1/sweeps/<id>".
[[nodiscard]] std::string sweep_path(std::string_view id);

/// What became of its points: so many successful, failed, reused (of the successful ones) and remaining.
[[nodiscard]] nlohmann::ordered_json sweep_counts(const SweepRecord& sweep);

[[nodiscard]] std::string sweep_status_document(const SweepRecord& sweep);

/// A page of sweeps; `next` is the path of the following page, empty on the last.
[[nodiscard]] std::string sweep_list_document(const SweepPage& page, std::string_view next);

/// application/problem+json for a request; to a client that speaks the protocol of Hops a document of that
/// protocol, which has room for sentences only.
[[nodiscard]] Response problem_response(const Problem& problem, const Request& request);

}  // namespace snapthrough::server::http
