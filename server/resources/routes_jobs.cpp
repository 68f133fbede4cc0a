#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/result_table.h"
#include "server/resources/body_sources.h"
#include "server/resources/documents.h"
#include "server/resources/events.h"
#include "server/resources/negotiation.h"
#include "server/resources/prefer.h"
#include "server/resources/records.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {
namespace {

/// Returns the problem of a failed job: 422 for the client's model, 500 for the service.
Problem failure_problem(const JobFailure& failure) {
  static constexpr std::array kOwnFaults{"internal_error", "out_of_memory", "crashed", "not_stored"};
  const bool own_fault = std::find(kOwnFaults.begin(), kOwnFaults.end(), failure.code) != kOwnFaults.end();
  return {own_fault ? 500 : 422, "analysis-failed", "The analysis could not be completed", failure.detail, {},
          failure.code,          failure.reached};
}

/// Returns a strong entity tag: a result never changes, so the job's id identifies it.
std::string result_etag(const std::string& id, const std::string& form) {
  return "\"" + id + "." + form + "\"";
}

enum class Form { json, csv, none };

std::optional<std::string> query_value(const Request& request, std::string_view name) {
  const auto found = std::find_if(request.query.begin(), request.query.end(),
                                  [&](const auto& one) { return one.first == name; });
  return found == request.query.end() ? std::nullopt : std::optional(found->second);
}

/// Returns the form of a result that the client accepts (?format= before Accept); CSV if only `table` is
/// given, else what it weighs higher, JSON if it accepts both alike.
Form wanted_form(const Request& request) {
  if (const auto value = query_value(request, "format")) {
    return *value == "csv" ? Form::csv : *value == "json" ? Form::json : Form::none;
  }
  if (query_value(request, "table")) {
    return Form::csv;
  }
  const std::optional<std::string_view> accept = request.header("Accept");
  if (!accept || trimmed(*accept).empty()) {
    return Form::json;
  }
  static constexpr std::array<std::string_view, 2> kTypes{"application/json", "text/csv"};
  const std::optional<std::size_t> best = preferred_type(*accept, kTypes);
  return !best ? Form::none : *best == 0 ? Form::json : Form::csv;
}

/// Returns the Preference-Applied header (RFC 7240) of a response.
std::string applied_preferences(const Preferences& preferences, bool with_result, std::chrono::seconds wait) {
  std::vector<std::string> applied;
  if (preferences.respond_async) {
    applied.emplace_back("respond-async");
  }
  if (preferences.return_shape == ReturnPreference::minimal && !with_result) {
    applied.emplace_back("return=minimal");
  }
  if (preferences.return_shape == ReturnPreference::representation && with_result) {
    applied.emplace_back("return=representation");
  }
  if (preferences.wait_s) {
    applied.push_back("wait=" + std::to_string(wait.count()));
  }
  std::string list;
  for (const std::string& one : applied) {
    list += (list.empty() ? "" : ", ") + one;
  }
  return list;
}

/// Returns the table with a name, or the default table; nullopt when the analysis type lacks it.
std::optional<api::ResultTable> wanted_table(const std::optional<std::string>& name,
                                             const std::string& analysis_type) {
  const std::span<const api::ResultTable> tables = api::tables_of(analysis_type);
  if (!name) {
    return tables.empty() ? std::nullopt : std::optional(tables.front());
  }
  const std::optional<api::ResultTable> table = api::result_table_from(*name);
  return table && std::find(tables.begin(), tables.end(), *table) != tables.end() ? table : std::nullopt;
}

/// Returns the problem of an unreadable result: 404 when the job was deleted, else a failure of the store.
Response trouble_of_result(const Request& request, const std::string& id, const Status& status) {
  return status.code() == StatusCode::conflict ? job_missing(request, id) : store_trouble(request, status);
}

}  // namespace

Response Routes::create_job(const Request& request, const std::string& /*id*/) {
  if (!is_json(request.header("Content-Type").value_or(""))) {
    return simple_problem(request, 415, "unsupported-media-type", "Unsupported media type",
                          "A request document has Content-Type: application/json.");
  }
  return submit_job(request, request.body);
}

Response Routes::submit_job(const Request& request, std::string_view document) {
  const std::optional<std::string_view> key = request.header("Idempotency-Key");
  if (std::optional<Response> refusal = refused_key(request)) {
    return *std::move(refusal);
  }
  const bool waits = wait_of(read_preferences(request)).count() > 0;
  Order order{document, request.id, request.owner, key, waits, !wants_fresh(request)};
  for (;;) {
    StatusOr<Submission> outcome = jobs_.submit(order);
    if (!outcome.ok()) {
      return store_trouble(request, outcome.status());
    }
    Submission submission = std::move(outcome).value();
    if (std::optional<Response> refusal = refusal_of(request, submission, "jobs")) {
      return *std::move(refusal);
    }
    Response response = created(request, submission);
    const bool deleted_meanwhile = submission.kind == Submission::Kind::reused && response.status == 404;
    if (!deleted_meanwhile) {
      return response;
    }
    order.reuse = false;  // the next job is new, so this happens once
  }
}

/// Returns how long a submission waits: as preferred (limited), else 0 for a job, the default for a result.
std::chrono::seconds Routes::wait_of(const Preferences& preferences) const {
  if (preferences.wait_s) {
    return std::min(std::chrono::seconds(*preferences.wait_s), waits_.longest_wait);
  }
  return preferences.wants_job() ? std::chrono::seconds(0) : waits_.default_wait;
}

/// Answers when the job has ended or the wait is over.
Response Routes::when_ended(const Request& request, const std::string& id, std::chrono::seconds wait,
                            std::function<Response()> answer) {
  if (wait.count() <= 0) {
    return answer();
  }
  const auto ticket = std::make_shared<JobCompletions::Ticket>(jobs_.context().completions, id);
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value() || is_final((*job)->state)) {
    return answer();
  }
  Response response;
  response.deferred = Deferred{[ticket](std::function<void()> wake) { ticket->on_end(std::move(wake)); },
                               wait, [ticket, answer = std::move(answer)] { return answer(); }};
  return response;
}

Response Routes::created(const Request& request, const Submission& submission) {
  // The function's owner keeps the request alive (see Gateway).
  return when_ended(request, submission.id, wait_of(read_preferences(request)),
                    [this, &request, id = submission.id, kind = submission.kind] {
                      return answer_of_post(request, id, kind);
                    });
}

/// Returns 200 with a result, 202 with a job whose result is not ready, 201 with a new job; 200 with a job
/// only if the client asked for a job.
Response Routes::answer_of_post(const Request& request, const std::string& id, Submission::Kind kind) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value()) {
    return job.ok() ? job_missing(request, id) : store_trouble(request, job.status());
  }
  const Preferences preferences = read_preferences(request);
  const bool with_result = !preferences.wants_job() && is_final((*job)->state);
  Response response;
  if (with_result) {
    response = result_of(request, **job);
  } else {
    response = json_response(201, job_status_document(**job, jobs_.progress(**job)));
    if (preferences.wants_job()) {
      const bool is_new = kind == Submission::Kind::stored || kind == Submission::Kind::copied;
      response.status = is_new ? 201 : 200;
    } else if (preferences.return_shape == ReturnPreference::representation) {
      response.status = 202;
      response.headers.emplace_back("Retry-After", "1");
    }
  }
  response.headers.emplace_back("Location", job_path(id));
  const bool hit = kind == Submission::Kind::reused || kind == Submission::Kind::copied;
  response.headers.emplace_back("X-Cache", hit ? "hit" : "miss");
  const std::string applied = applied_preferences(preferences, with_result, wait_of(preferences));
  if (response.status < 400 && !applied.empty()) {
    response.headers.emplace_back("Preference-Applied", applied);
  }
  return response;
}

Response Routes::status_of_job(const Request& request, const std::string& id) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok()) {
    return store_trouble(request, job.status());
  }
  return job->has_value() ? json_response(200, job_status_document(**job, jobs_.progress(**job)))
                          : job_missing(request, id);
}

Response Routes::list_jobs(const Request& request, const std::string& /*id*/) {
  ListQuery query;
  query.owner = request.owner;
  if (std::optional<Response> refusal = read_list_query(request, query)) {
    return *std::move(refusal);
  }
  const StatusOr<JobPage> page = jobs_.store().list(query);
  if (!page.ok()) {
    return store_trouble(request, page.status());
  }
  const std::string next = next_page(request, page->next);
  return list_page(job_list_document(*page, next), next);
}

Response Routes::job_status(const Request& request, const std::string& id) {
  const std::chrono::seconds wait{read_preferences(request).wait_s.value_or(0)};
  // The function's owner keeps the request alive (see Gateway).
  return when_ended(request, id, std::min(wait, waits_.longest_wait),
                    [this, &request, id] { return status_of_job(request, id); });
}

Response Routes::job_result(const Request& request, const std::string& id) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok()) {
    return store_trouble(request, job.status());
  }
  return job->has_value() ? result_of(request, **job) : job_missing(request, id);
}

Response Routes::job_csv(const Request& request, const std::string& id) {
  std::optional<Request> csv = as_csv(request);
  if (!csv) {
    return wrong_parameter(request, "table: the form is that of the address", "format", "");
  }
  return when_ended(request, id, waits_.default_wait,
                    [this, csv = *std::move(csv), id] { return job_result(csv, id); });
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
  const Form form = wanted_form(request);
  if (form == Form::none) {
    return simple_problem(request, 406, "not-acceptable", "Not acceptable",
                          "A result is application/json, or text/csv (its paths).");
  }
  const std::optional<std::string> name = query_value(request, "table");
  const std::optional<api::ResultTable> table =
      form == Form::csv ? wanted_table(name, job.analysis_type) : std::nullopt;
  if (!table && (name || form == Form::csv)) {
    return wrong_parameter(request,
                           "table (CSV: " + api::table_names(api::tables_of(job.analysis_type)) + ")",
                           "table", name.value_or(""));
  }
  const std::string etag = result_etag(job.id, form == Form::csv ? "csv." + name.value_or("") : "json");
  Response response;
  if (request.method != "POST" && matches_etag(request, etag)) {
    response.status = 304;
  } else if (table) {
    response = table_of_result(request, job, *table);
  } else {
    StatusOr<Response> begun = begin_body(result_source(jobs_.store(), job.id));
    if (!begun.ok()) {
      return trouble_of_result(request, job.id, begun.status());
    }
    response = std::move(begun).value();
    response.content_type = "application/json";
  }
  if (response.status < 400) {
    response.headers.emplace_back("ETag", etag);
    response.headers.emplace_back("Cache-Control", "private, max-age=86400, immutable");
    response.headers.emplace_back("Content-Location", job_path(job.id) + "/result");
    add_provenance(job.program, job.request_sha256, response);
  }
  return response;
}

Response Routes::table_of_result(const Request& request, const Job& job, api::ResultTable table) {
  StatusOr<std::shared_ptr<BodySource>> source = result_table_source(jobs_.store(), job.id, table);
  if (!source.ok()) {
    return trouble_of_result(request, job.id, source.status());
  }
  StatusOr<Response> begun = begin_body(std::move(source).value());
  if (!begun.ok()) {
    return trouble_of_result(request, job.id, begun.status());
  }
  Response response = std::move(begun).value();
  response.content_type = "text/csv; charset=utf-8; header=present";
  return response;
}

Response Routes::job_request(const Request& request, const std::string& id) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value()) {
    return job.ok() ? job_missing(request, id) : store_trouble(request, job.status());
  }
  StatusOr<std::optional<std::string>> document = jobs_.store().request(id);
  if (!document.ok()) {
    return store_trouble(request, document.status());
  }
  if (!document->has_value()) {
    return job_missing(request, id);
  }
  return json_response(200, *std::move(document).value());
}

Response Routes::job_events(const Request& request, const std::string& id) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value()) {
    return job.ok() ? job_missing(request, id) : store_trouble(request, job.status());
  }
  const std::optional<std::uint64_t> end = is_final((*job)->state) ? std::optional(kEndOfJob) : std::nullopt;
  return event_stream(request, end, [this, id](std::uint64_t last, Stream::Push push) {
    return follow_job(jobs_, id, last, std::move(push));
  });
}

Response Routes::dismiss_job(const Request& request, const std::string& id) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value()) {
    return job.ok() ? job_missing(request, id) : store_trouble(request, job.status());
  }
  const StatusOr<Dismissal> dismissal = jobs_.dismiss(id);
  if (!dismissal.ok()) {
    return store_trouble(request, dismissal.status());
  }
  if (!dismissal->found) {
    return job_missing(request, id);
  }
  if (is_final(dismissal->before) && dismissal->before != JobState::dismissed) {
    return simple_problem(request, 409, "already-finished", "Already finished",
                          "The job is " + std::string(to_string(dismissal->before)) + " already.");
  }
  return status_of_job(request, id);
}

Response Routes::delete_job(const Request& request, const std::string& id) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value()) {
    return job.ok() ? job_missing(request, id) : store_trouble(request, job.status());
  }
  if (const Status status = jobs_.remove(id); !status.ok()) {
    return store_trouble(request, status);
  }
  Response response;
  response.status = 204;
  return response;
}

}  // namespace snapthrough::server::http
