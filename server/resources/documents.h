#pragma once
/// @file
/// JSON documents of the interface other than requests and results: job status, lists, problems; and the
/// responses that several resources make of them.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/message.h"
#include "server/status.h"
#include "server/store/ledger_store.h"
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

/// Returns a page of events; `next` is the path of the next page, "" on the last one.
[[nodiscard]] std::string audit_document(std::string_view owner, std::span<const AuditEntry> entries,
                                         std::string_view next);

/// Returns application/problem+json; for a request of the Hops protocol a document of that protocol, which
/// can only hold sentences.
[[nodiscard]] Response problem_response(const Problem& problem, const Request& request);
/// Returns a problem without findings.
[[nodiscard]] Response simple_problem(const Request& request, int status, const char* kind, const char* title,
                                      std::string detail);
/// Returns a problem with status 401 and the WWW-Authenticate that belongs to it.
[[nodiscard]] Response unauthorized(const Request& request, const char* kind, const char* title,
                                    std::string detail);
/// Returns the problem of an operation that the store refused or could not do.
[[nodiscard]] Response store_trouble(const Request& request, const Status& status);
[[nodiscard]] Response job_missing(const Request& request, const std::string& id);
[[nodiscard]] Response sweep_missing(const Request& request, const std::string& id);

/// Returns a response with a JSON document.
[[nodiscard]] Response json_response(int status, std::string body);

}  // namespace snapthrough::server::http
