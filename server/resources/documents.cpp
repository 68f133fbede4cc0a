#include "server/resources/documents.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/api.h"
#include "server/resources/hops/protocol.h"
#include "server/resources/records.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::ordered_json;

std::string to_text(const ordered_json& document) {
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json optional_time(const std::optional<Time>& time) {
  return time ? ordered_json(rfc3339(*time)) : ordered_json(nullptr);
}

ordered_json link(std::string_view rel, const std::string& href) {
  return {{"rel", rel}, {"href", href}, {"type", "application/json"}};
}

/// Returns the links of a page of a list: that to the next page, unless `next` is "".
ordered_json page_links(std::string_view next) {
  return next.empty() ? ordered_json::array() : ordered_json::array({link("next", std::string(next))});
}

/// Adds label, metadata and callback, each if the client gave it.
void add_annotations(const Annotations& annotations, ordered_json& status) {
  if (!annotations.label.empty()) {
    status["label"] = annotations.label;
  }
  if (!annotations.metadata.empty()) {
    status["metadata"] = ordered_json::parse(annotations.metadata);
  }
  if (!annotations.callback.empty()) {
    status["callback"] = annotations.callback;
  }
}

/// Adds what made the outcome and what that took, null where it is not known.
void add_provenance(const std::string& program, const std::string& request_sha256,
                    const std::optional<WorkUsage>& usage, ordered_json& status) {
  status["program"] = program.empty() ? ordered_json() : ordered_json::parse(program);
  status["request_sha256"] = request_sha256.empty() ? ordered_json() : ordered_json(request_sha256);
  status["usage"] = usage ? work_json(*usage) : ordered_json();
}

std::string status_message(const Job& job, const std::optional<Progress>& progress) {
  if (job.failure) {
    return job.failure->detail;
  }
  if (job.state == JobState::running && progress) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "branch %d, step %d, load factor %.6g, negative eigenvalues %d",
                  progress->branch, progress->step, progress->load_factor, progress->negative_eigenvalues);
    return text.data();
  }
  switch (job.state) {
    case JobState::accepted:
      return "waits for a worker";
    case JobState::running:
      return "runs";
    case JobState::successful:
      return "the result is ready";
    case JobState::failed:
    case JobState::dismissed:
      break;
  }
  return std::string(to_string(job.state));
}

ordered_json job_status(const Job& job, const std::optional<Progress>& progress) {
  const std::string path = job_path(job.id);
  ordered_json links = ordered_json::array({link("self", path), link("request", path + "/request")});
  if (is_final(job.state)) {
    links.push_back(link("result", path + "/result"));
  }
  ordered_json status{
      {"id", job.id},
      {"kind", "job"},
      {"status", to_string(job.state)},
      // The length of an equilibrium path is unknown before its end; the message gives the current point.
      {"progress", is_final(job.state) ? 100 : 0},
      {"message", status_message(job, progress)},
      {"title", job.title},
      {"analysis", job.analysis_type},
      {"attempt", job.attempt},
      {"created", rfc3339(job.created)},
      {"started", optional_time(job.started)},
      {"finished", optional_time(job.finished)}};
  add_provenance(job.program, job.request_sha256, job.usage, status);
  add_annotations(job.annotations, status);
  if (job.failure) {
    status["error"] = {{"code", job.failure->code}, {"detail", job.failure->detail}};
  }
  status["links"] = std::move(links);
  return status;
}

std::string sweep_message(const SweepRecord& sweep) {
  switch (sweep.state) {
    case JobState::accepted:
      return "waits for a worker";
    case JobState::running:
      return std::to_string(sweep.done()) + " of " + std::to_string(sweep.points) + " points are done";
    case JobState::successful:
      return "the table is complete";
    case JobState::failed:
      return "the table is complete; " + std::to_string(sweep.failed) + " of " +
             std::to_string(sweep.points) + " points failed";
    case JobState::dismissed:
      return std::string(to_string(sweep.state)) + "; " + std::to_string(sweep.done()) + " of " +
             std::to_string(sweep.points) + " points have a row";
  }
  return "";
}

ordered_json sweep_status(const SweepRecord& sweep) {
  const std::string path = sweep_path(sweep.id);
  ordered_json status{{"id", sweep.id},
                      {"kind", "sweep"},
                      {"status", to_string(sweep.state)},
                      {"progress", 100 * sweep.done() / std::max<std::int64_t>(sweep.points, 1)},
                      {"message", sweep_message(sweep)},
                      {"title", sweep.title},
                      {"analysis", sweep.analysis_type},
                      {"points", sweep.points},
                      {"counts", sweep_counts(sweep)},
                      {"created", rfc3339(sweep.created)},
                      {"started", optional_time(sweep.started)},
                      {"finished", optional_time(sweep.finished)}};
  add_provenance(sweep.program, sweep.request_sha256, sweep.usage, status);
  add_annotations(sweep.annotations, status);
  status["links"] = ordered_json::array(
      {link("self", path), link("request", path + "/request"), link("table", path + "/table")});
  return status;
}

}  // namespace

std::string sweep_path(std::string_view id) { return "/v1/sweeps/" + std::string(id); }

ordered_json sweep_counts(const SweepRecord& sweep) {
  return {{to_string(JobState::successful), sweep.successful},
          {to_string(JobState::failed), sweep.failed},
          {"reused", sweep.reused},
          {"remaining", sweep.points - sweep.done()}};
}

std::string sweep_status_document(const SweepRecord& sweep) { return to_text(sweep_status(sweep)); }

std::string sweep_list_document(const SweepPage& page, std::string_view next) {
  ordered_json sweeps = ordered_json::array();
  for (const SweepRecord& sweep : page.sweeps) {
    sweeps.push_back(sweep_status(sweep));
  }
  return to_text({{"sweeps", std::move(sweeps)}, {"links", page_links(next)}});
}

std::string job_path(std::string_view id) { return "/v1/jobs/" + std::string(id); }

std::string job_status_document(const Job& job, const std::optional<Progress>& progress) {
  return to_text(job_status(job, progress));
}

std::string job_list_document(const JobPage& page, std::string_view next) {
  ordered_json jobs = ordered_json::array();
  for (const Job& job : page.jobs) {
    jobs.push_back(job_status(job, std::nullopt));
  }
  return to_text({{"jobs", std::move(jobs)}, {"links", page_links(next)}});
}

std::string audit_document(std::string_view owner, std::span<const AuditEntry> entries,
                           std::string_view next) {
  ordered_json list = ordered_json::array();
  for (const AuditEntry& entry : entries) {
    list.push_back({{"time", rfc3339(entry.at)},
                    {"event", to_string(entry.event)},
                    {"kind", entry.sweep ? "sweep" : "job"},
                    {"id", entry.id},
                    {"owner", owner}});
  }
  return to_text({{"count", entries.size()}, {"events", std::move(list)}, {"links", page_links(next)}});
}

namespace {

/// Returns a problem in sentences, for clients that show no other part of it.
std::vector<std::string> sentences_of(const Problem& problem) {
  if (!problem.errors.empty()) {
    return hops::sentences_of(problem.errors);
  }
  const std::string code = problem.code.empty() ? "" : " (" + problem.code + ")";
  return {problem.title + ": " + problem.detail + code};
}

}  // namespace

Response problem_response(const Problem& problem, const Request& request) {
  if (const hops::Form form = hops::form_of(request.method, request.path); form != hops::Form::none) {
    Response response;
    response.status = problem.status;
    response.content_type = "application/json";
    response.body = hops::refusal(form, sentences_of(problem));
    return response;
  }
  ordered_json document{{"type", "urn:snapthrough:problem:" + problem.kind},
                        {"title", problem.title},
                        {"status", problem.status},
                        {"detail", problem.detail},
                        {"instance", request.path},
                        {"request_id", request.id}};
  if (!problem.errors.empty()) {
    document["errors"] = api::write_findings(problem.errors);
  }
  if (!problem.code.empty()) {
    document["code"] = problem.code;
  }
  if (!problem.reached.empty()) {
    document["reached"] = ordered_json::parse(problem.reached);
  }
  Response response;
  response.status = problem.status;
  response.content_type = "application/problem+json";
  response.body = to_text(document);
  return response;
}

Response simple_problem(const Request& request, int status, const char* kind, const char* title,
                        std::string detail) {
  return problem_response({status, kind, title, std::move(detail), {}, "", ""}, request);
}

Response unauthorized(const Request& request, const char* kind, const char* title, std::string detail) {
  Response refused = simple_problem(request, 401, kind, title, std::move(detail));
  refused.headers.emplace_back("WWW-Authenticate", "Bearer");
  return refused;
}

Response store_trouble(const Request& request, const Status& status) {
  Response response;
  switch (status.code()) {
    case StatusCode::stopping:
      response = simple_problem(request, 503, "not-ready", "Not ready", status.message());
      response.headers.emplace_back("Retry-After", "5");
      return response;
    case StatusCode::waiting_quota:
      response = simple_problem(request, 429, "waiting-quota", "Quota of waiting work", status.message());
      response.headers.emplace_back("Retry-After", "10");
      return response;
    case StatusCode::rate_quota:
      response = simple_problem(request, 429, "rate-quota", "Quota of an hour", status.message());
      response.headers.emplace_back("Retry-After", "60");
      return response;
    case StatusCode::storage_quota:
      return simple_problem(request, 403, "storage-quota", "Quota of storage", status.message());
    case StatusCode::unavailable:
      response = simple_problem(request, 503, "store-unavailable", "Service unavailable",
                                "The store cannot be used at the moment.");
      response.headers.emplace_back("Retry-After", "5");
      break;
    default:
      response = simple_problem(request, 500, "internal-error", "Internal error", "The store failed.");
  }
  response.trouble = status.message();
  return response;
}

Response job_missing(const Request& request, const std::string& id) {
  return simple_problem(request, 404, "no-such-job", "No such job",
                        "There is no job with the id " + id + ".");
}

Response sweep_missing(const Request& request, const std::string& id) {
  return simple_problem(request, 404, "no-such-sweep", "No such sweep",
                        "There is no sweep with the id " + id + ".");
}

Response json_response(int status, std::string body) {
  Response response;
  response.status = status;
  response.content_type = "application/json";
  response.body = std::move(body);
  return response;
}

}  // namespace snapthrough::server::http
