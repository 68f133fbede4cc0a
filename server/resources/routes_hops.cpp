#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/json_text.h"
#include "server/jobs/memory.h"
#include "server/resources/body_sources.h"
#include "server/resources/documents.h"
#include "server/resources/hops/protocol.h"
#include "server/resources/negotiation.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Largest result document in bytes that is read for an answer; larger ones have too many values anyway.
constexpr std::size_t kLargestResult = 64 * 1024 * 1024;

/// Name of the address that calls any component, and last segment of the address that calls the component in
/// `pointer`.
constexpr std::string_view kSolve = "solve";

Response component_missing(const Request& request, const std::string& name,
                           const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& one : names) {
    all += (all.empty() ? "" : ", ") + one;
  }
  return simple_problem(
      request, 404, "not-found", "No such component",
      "There is no component named \"" + name + "\"; the components of this service are " + all + ".");
}

Response wrong_call(const Request& request, int status, std::vector<Finding> findings) {
  return problem_response({status, "invalid-request", "Invalid request", "", std::move(findings), "", ""},
                          request);
}

/// Returns the members of a result document with one of the names, and `warnings`; all members for no names.
json parts_of(const std::string& text, const std::vector<std::string>& parts) {
  return json::parse(text, [&](int depth, json::parse_event_t event, json& value) {
    return depth != 1 || event != json::parse_event_t::key || parts.empty() || value == "warnings" ||
           std::find(parts.begin(), parts.end(), value.get_ref<const std::string&>()) != parts.end();
  });
}

/// Returns the text of a result; `unsupported` when it exceeds kLargestResult.
StatusOr<std::string> whole_result(Store& store, const std::string& job) {
  const std::shared_ptr<BodySource> source = result_source(store, job);
  std::string text;
  for (bool more = true; more;) {
    const StatusOr<bool> read = source->append_next(text);
    if (!read.ok()) {
      return read.status();
    }
    more = *read;
    if (text.size() > kLargestResult) {
      return Status(StatusCode::unsupported, "the result document has more than 64 MB");
    }
  }
  return text;
}

/// Returns findings about a call other than its values.
std::vector<Finding> mistakes_of(const api::ParsedText& parsed) {
  if (parsed.document == nullptr) {
    return parsed.findings;
  }
  if (!parsed.document->is_object()) {
    return {{"", "wrong_type", "a call is an object with pointer and values"}};
  }
  const json algorithm = parsed.document->value("algo", json());
  if (!algorithm.is_null() && algorithm != json("")) {
    return {
        {"/algo", "not_supported", "this service computes its own components, no Grasshopper definitions"}};
  }
  return {};
}

}  // namespace

Response Routes::list_components(const Request& /*request*/, const std::string& /*id*/) {
  ordered_json list = ordered_json::array();
  for (const std::string& name : components_.names()) {
    if (const std::optional<hops::Entry> entry = components_.find(name)) {
      list.push_back(hops::description(name, *entry));
    }
  }
  return json_response(200, list.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

Response Routes::describe_component(const Request& request, const std::string& name) {
  const std::optional<hops::Entry> entry = components_.find(name);
  if (!entry) {
    return component_missing(request, name, components_.names());
  }
  return json_response(
      entry->errors.empty() ? 200 : 500,
      hops::description(name, *entry).dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

Response Routes::solve(const Request& request, const std::string& /*id*/) {
  return solve_component(request, std::string(kSolve));
}

Response Routes::solve_component(const Request& request, const std::string& name) {
  if (!is_json(request.header("Content-Type").value_or(""))) {
    return simple_problem(request, 415, "unsupported-media-type", "Unsupported media type",
                          "A call has Content-Type: application/json.");
  }
  const LargeDocument room(request.body.size());
  const api::ParsedText parsed = api::parse_json(request.body, {.keys = jobs_.limits().json_keys});
  if (std::vector<Finding> findings = mistakes_of(parsed); !findings.empty()) {
    return wrong_call(request, parsed.document == nullptr ? 400 : 422, std::move(findings));
  }
  const std::string called = name == kSolve ? hops::name_in(*parsed.document) : name;
  const std::optional<hops::Entry> entry = components_.find(called);
  if (!entry) {
    return component_missing(request, called, components_.names());
  }
  if (!entry->errors.empty()) {
    return simple_problem(request, 500, "internal-error", "The file of this component is wrong",
                          entry->errors.front());
  }
  hops::ReadValues read = hops::read_values(*parsed.document, *entry->definition);
  hops::Call call = entry->definition->call(read.values);
  for (Finding& finding : call.findings) {
    const bool known = std::any_of(read.findings.begin(), read.findings.end(),
                                   [&](const Finding& one) { return one.pointer == finding.pointer; });
    if (!known) {
      read.findings.push_back(std::move(finding));
    }
  }
  if (!read.findings.empty()) {
    return wrong_call(request, 422, std::move(read.findings));
  }
  return submit_call(request, called, entry->definition, call.request);
}

Response Routes::submit_call(const Request& request, const std::string& name,
                             const std::shared_ptr<const hops::Definition>& definition,
                             const std::string& document) {
  StatusOr<Submission> outcome =
      jobs_.submit({document, request.id, request.owner, std::nullopt, true, !wants_fresh(request)});
  if (!outcome.ok()) {
    return store_trouble(request, outcome.status());
  }
  Submission submission = std::move(outcome).value();
  for (Finding& finding : submission.findings) {
    const std::string input = definition->input_at(finding.pointer);
    finding.detail += input.empty() ? "" : " (input " + input + ")";
  }
  if (std::optional<Response> refusal = refusal_of(request, submission, "jobs")) {
    return *std::move(refusal);
  }
  // The function's owner keeps the request alive (see Gateway).
  return when_ended(request, submission.id, waits_.longest_wait,
                    [this, &request, name, definition, id = submission.id] {
                      Response response = answer_call(request, name, definition, id);
                      response.headers.emplace_back("Location", job_path(id));
                      return response;
                    });
}

Response Routes::answer_call(const Request& request, const std::string& name,
                             const std::shared_ptr<const hops::Definition>& definition,
                             const std::string& id) {
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value()) {
    return job.ok() ? job_missing(request, id) : store_trouble(request, job.status());
  }
  if (!is_final((*job)->state)) {
    Response response = simple_problem(
        request, 503, "result-not-ready", "No result yet",
        "The analysis is not done after " + std::to_string(waits_.longest_wait.count()) +
            " s; it goes on as " + job_path(id) + ". The same inputs are answered at once when it is done.");
    response.headers.emplace_back("Retry-After", "10");
    return response;
  }
  if ((*job)->state != JobState::successful) {
    return result_of(request, **job);  // returns a refusal
  }
  const StatusOr<std::string> text = whole_result(jobs_.store(), id);
  if (!text.ok()) {
    return text.status().code() == StatusCode::unsupported
               ? simple_problem(request, 422, "table-too-large", "Too many values", text.status().message())
               : store_trouble(request, text.status());
  }
  const LargeDocument room(text->size());
  hops::Answer answer =
      hops::answer(*definition, "v1/hops/" + name, parts_of(*text, definition->parts()), job_path(id));
  return answer.error.empty()
             ? json_response(200, std::move(answer.text))
             : simple_problem(request, 422, "table-too-large", "Too many values", answer.error);
}

}  // namespace snapthrough::server::http
