#include "server/http/routes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "server/http/prefer.h"

namespace snapthrough::server::http {
namespace {

constexpr int kDefaultPage = 20;
constexpr int kLargestPage = 1000;

Response json_response(int status, std::string body) {
  Response response;
  response.status = status;
  response.content_type = "application/json";
  response.body = std::move(body);
  return response;
}

Response simple_problem(const Request& request, int status, const char* kind, const char* title,
                        std::string detail) {
  return problem_response({status, kind, title, std::move(detail), {}, "", ""}, request);
}

Response store_trouble(const Request& request, const Status& status) {
  Response response;
  if (status.code() == StatusCode::unavailable) {
    response = simple_problem(request, 503, "store-unavailable", "Service unavailable",
                              "The store cannot be used at the moment.");
    response.headers.emplace_back("Retry-After", "5");
  } else {
    response = simple_problem(request, 500, "internal-error", "Internal error", "The store failed.");
  }
  response.trouble = status.message();
  return response;
}

Response refused_document(const Request& request, Submission submission) {
  Problem problem{422, "invalid-request", "Invalid request", "", std::move(submission.findings), "", ""};
  if (submission.malformed) {
    problem = {400, "malformed-json", "Malformed JSON", "", std::move(problem.errors), "", ""};
  }
  const std::size_t count = problem.errors.size();
  problem.detail = "The request document has " + std::to_string(count) + (count == 1 ? " error" : " errors") +
                   "; nothing was stored.";
  return problem_response(problem, request);
}

/// The problem of a failed job: the caller's model could not be analysed, or the service is to blame.
Problem failure_problem(const JobFailure& failure) {
  static constexpr std::array kOwnFaults{"internal_error", "out_of_memory", "crashed", "not_stored"};
  const bool own_fault = std::find(kOwnFaults.begin(), kOwnFaults.end(), failure.code) != kOwnFaults.end();
  return {own_fault ? 500 : 422, "analysis-failed", "The analysis could not be completed", failure.detail, {},
          failure.code,          failure.reached};
}

bool is_json(std::string_view content_type) {
  return equal_ignoring_case(trimmed(content_type.substr(0, content_type.find(';'))), "application/json");
}

template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// One parameter of a list's query; false when it is unknown or its value is not acceptable.
bool read_list_parameter(const std::string& name, const std::string& value, JobQuery& query) {
  if (name == "limit") {
    const std::optional<int> limit = whole_number<int>(value);
    query.limit = limit.value_or(0);
    return query.limit >= 1 && query.limit <= kLargestPage;
  }
  if (name == "cursor") {
    query.before = whole_number<std::int64_t>(value);
    return query.before.has_value();
  }
  if (name == "status") {
    query.state = job_state_from(value);
    return query.state.has_value();
  }
  return false;
}

std::string next_page(const JobQuery& query, std::int64_t cursor) {
  std::string path = "/v1/jobs?limit=" + std::to_string(query.limit) + "&cursor=" + std::to_string(cursor);
  if (query.state) {
    path += "&status=" + std::string(to_string(*query.state));
  }
  return path;
}

/// A result never changes, so its job's id is a strong validator.
std::string result_etag(const std::string& id) { return "\"" + id + ".json\""; }

bool matches_etag(const Request& request, const std::string& etag) {
  const std::optional<std::string_view> header = request.header("If-None-Match");
  if (!header) {
    return false;
  }
  const std::vector<std::string_view> tags = split_list(*header, ',');
  return std::any_of(tags.begin(), tags.end(), [&](std::string_view tag) {
    return tag == "*" || tag == etag || (tag.starts_with("W/") && tag.substr(2) == etag);
  });
}

/// Whether a path has the form of a route's pattern; "{id}" takes one segment, which is returned.
bool matches(std::string_view pattern, std::string_view path, std::string& id) {
  while (!pattern.empty() && !path.empty()) {
    const std::size_t pattern_end = std::min(pattern.find('/', 1), pattern.size());
    const std::size_t path_end = std::min(path.find('/', 1), path.size());
    if (pattern.substr(0, pattern_end) == "/{id}") {
      id = path.substr(1, path_end - 1);
    } else if (pattern.substr(0, pattern_end) != path.substr(0, path_end)) {
      return false;
    }
    pattern.remove_prefix(pattern_end);
    path.remove_prefix(path_end);
  }
  return pattern.empty() && path.empty();
}

}  // namespace

struct Routes::Route {
  const char* method;
  const char* pattern;
  Response (Routes::*handler)(const Request&, const std::string&);
};

const std::vector<Routes::Route>& Routes::table() {
  static const std::vector<Route> routes{
      {"POST", "/v1/jobs", &Routes::create_job},
      {"GET", "/v1/jobs", &Routes::list_jobs},
      {"GET", "/v1/jobs/{id}", &Routes::job_status},
      {"GET", "/v1/jobs/{id}/result", &Routes::job_result},
      {"GET", "/v1/jobs/{id}/request", &Routes::job_request},
      {"GET", "/livez", &Routes::alive},
  };
  return routes;
}

Response Routes::respond(const Request& request) {
  const std::string_view method = request.method == "HEAD" ? "GET" : std::string_view(request.method);
  std::string allowed;
  for (const Route& route : table()) {
    std::string id;
    if (!matches(route.pattern, request.path, id)) {
      continue;
    }
    if (method == route.method) {
      Response response = (this->*route.handler)(request, id);
      response.route = route.pattern;
      return response;
    }
    allowed += (allowed.empty() ? "" : ", ") + std::string(route.method);
    allowed += std::string_view(route.method) == "GET" ? ", HEAD" : "";
  }
  if (allowed.empty()) {
    return simple_problem(request, 404, "not-found", "Not found", "There is nothing at this path.");
  }
  Response response = simple_problem(request, 405, "method-not-allowed", "Method not allowed",
                                     "This resource answers " + allowed + ".");
  response.headers.emplace_back("Allow", allowed);
  return response;
}

Response Routes::create_job(const Request& request, const std::string& /*id*/) {
  if (!is_json(request.header("Content-Type").value_or(""))) {
    return simple_problem(request, 415, "unsupported-media-type", "Unsupported media type",
                          "A request document has Content-Type: application/json.");
  }
  StatusOr<Submission> submission = desk_.submit(request.body, request.id);
  if (!submission.ok()) {
    return store_trouble(request, submission.status());
  }
  if (submission->id.empty()) {
    return refused_document(request, std::move(submission).value());
  }
  Response response = created(request, *submission);
  response.headers.emplace_back("Location", job_path(submission->id));
  return response;
}

Response Routes::created(const Request& request, const Submission& submission) {
  const Preferences preferences = read_preferences(request);
  std::chrono::seconds wait = preferences.respond_async ? std::chrono::seconds(0) : limits_.default_wait;
  if (preferences.wait_s) {
    wait = std::min(std::chrono::seconds(*preferences.wait_s), limits_.longest_wait);
  }
  const StatusOr<std::optional<Job>> job = desk_.get(submission.id, wait);
  if (!job.ok()) {
    return store_trouble(request, job.status());
  }
  if (!job->has_value()) {
    return job_missing(request, submission.id);
  }
  if (wait.count() > 0 && is_final((*job)->state)) {
    return result_of(request, **job);
  }
  Response response = json_response(201, job_status_document(**job, desk_.progress(submission.id)));
  if (preferences.respond_async) {
    response.headers.emplace_back("Preference-Applied", "respond-async");
  }
  return response;
}

Response Routes::list_jobs(const Request& request, const std::string& /*id*/) {
  JobQuery query;
  query.limit = kDefaultPage;
  for (const auto& [name, value] : request.query) {
    if (!read_list_parameter(name, value, query)) {
      return simple_problem(request, 400, "invalid-parameter", "Invalid parameter",
                            "The query parameters are limit (1 to " + std::to_string(kLargestPage) +
                                "), cursor (from a next link) and status; this is none of them: " + name +
                                "=" + value);
    }
  }
  const StatusOr<JobPage> page = desk_.store().list(query);
  if (!page.ok()) {
    return store_trouble(request, page.status());
  }
  const std::string next = page->next ? next_page(query, *page->next) : "";
  Response response = json_response(200, job_list_document(*page, next));
  if (!next.empty()) {
    response.headers.emplace_back("Link", "<" + next + ">; rel=\"next\"");
  }
  return response;
}

Response Routes::job_status(const Request& request, const std::string& id) {
  const std::chrono::seconds wait{read_preferences(request).wait_s.value_or(0)};
  const StatusOr<std::optional<Job>> job = desk_.get(id, std::min(wait, limits_.longest_wait));
  if (!job.ok()) {
    return store_trouble(request, job.status());
  }
  if (!job->has_value()) {
    return job_missing(request, id);
  }
  return json_response(200, job_status_document(**job, desk_.progress(id)));
}

Response Routes::job_result(const Request& request, const std::string& id) {
  const StatusOr<std::optional<Job>> job = desk_.get(id, std::chrono::seconds(0));
  if (!job.ok()) {
    return store_trouble(request, job.status());
  }
  if (!job->has_value()) {
    return job_missing(request, id);
  }
  return result_of(request, **job);
}

Response Routes::result_of(const Request& request, const Job& job) {
  if (job.failure) {
    return problem_response(failure_problem(*job.failure), request);
  }
  if (!is_final(job.state)) {
    Response response = simple_problem(request, 404, "result-not-ready", "Result not ready",
                                       "The job is " + std::string(to_string(job.state)) + ".");
    response.headers.emplace_back("Retry-After", "1");
    return response;
  }
  if (job.state == JobState::dismissed) {
    return simple_problem(request, 404, "dismissed", "No result", "The job was dismissed.");
  }
  const std::string etag = result_etag(job.id);
  Response response;
  if (request.method != "POST" && matches_etag(request, etag)) {
    response.status = 304;
  } else {
    StatusOr<std::optional<std::string>> document = desk_.store().result(job.id);
    if (!document.ok()) {
      return store_trouble(request, document.status());
    }
    if (!document->has_value()) {
      return job_missing(request, job.id);
    }
    response = json_response(200, *std::move(document).value());
  }
  response.headers.emplace_back("ETag", etag);
  response.headers.emplace_back("Cache-Control", "private, max-age=86400, immutable");
  response.headers.emplace_back("Content-Location", job_path(job.id) + "/result");
  return response;
}

Response Routes::job_request(const Request& request, const std::string& id) {
  StatusOr<std::optional<std::string>> document = desk_.store().request(id);
  if (!document.ok()) {
    return store_trouble(request, document.status());
  }
  if (!document->has_value()) {
    return job_missing(request, id);
  }
  return json_response(200, *std::move(document).value());
}

Response Routes::alive(const Request& /*request*/, const std::string& /*id*/) {
  Response response = json_response(200, "{\"status\":\"ok\"}");
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

Response Routes::job_missing(const Request& request, const std::string& id) const {
  return simple_problem(request, 404, "no-such-job", "No such job",
                        "There is no job with the id " + id + ".");
}

}  // namespace snapthrough::server::http
