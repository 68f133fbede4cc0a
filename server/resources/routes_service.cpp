#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/api.h"
#include "api/check_document.h"
#include "api/openapi/document.h"
#include "api/sweep.h"
#include "server/jobs/envelope.h"
#include "server/jobs/memory.h"
#include "server/resources/documents.h"
#include "server/resources/embedded.h"
#include "server/resources/negotiation.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::ordered_json;

/// Returns a request or a sweep, with or without its envelope.
Envelope opened(std::string_view body, const JobLimits& limits) {
  Envelope envelope = open_envelope(body, "request", limits);
  if (envelope.document != nullptr && envelope.pointer.empty() && envelope.document->is_object() &&
      envelope.document->contains("sweep")) {
    envelope = open_envelope(body, "sweep", limits);
  }
  return envelope;
}

Response fresh(Response response) {
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

}  // namespace

Response Routes::check(const Request& request, const std::string& /*id*/) {
  if (!is_json(request.header("Content-Type").value_or(""))) {
    return simple_problem(request, 415, "unsupported-media-type", "Unsupported media type",
                          "A request document has Content-Type: application/json.");
  }
  const LargeDocument room(request.body.size());
  const Envelope envelope = opened(request.body, jobs_.limits());
  if (envelope.malformed) {
    return problem_response({400, "malformed-json", "Malformed JSON", "The body is no acceptable JSON text.",
                             envelope.findings, "", ""},
                            request);
  }
  const JobLimits& limits = jobs_.limits();
  const auto needs_too_much = [&limits](const api::Request& read) {
    return check_memory(read.model, read.analysis, limits.job_memory);
  };
  const bool sweep = envelope.pointer == "/sweep" || api::is_sweep(*envelope.document);
  api::CheckedDocument checked =
      sweep ? api::check_sweep(envelope.document, static_cast<std::uint64_t>(limits.sweep_points),
                               needs_too_much)
            : api::check_request(envelope.document, needs_too_much);
  checked.findings = in_envelope(envelope, std::move(checked.findings));
  return json_response(200, api::write_check(checked));
}

Response Routes::limits(const Request& /*request*/, const std::string& /*id*/) {
  ordered_json document = ordered_json::object();
  for (const auto& [name, value] : facts_.limits) {
    document[name] = value == static_cast<double>(static_cast<std::int64_t>(value))
                         ? ordered_json(static_cast<std::int64_t>(value))
                         : ordered_json(value);
  }
  return json_response(200, document.dump());
}

Response Routes::openapi(const Request& /*request*/, const std::string& /*id*/) {
  return json_response(200, std::string(api::openapi_document()));
}

Response Routes::examples(const Request& /*request*/, const std::string& /*id*/) {
  ordered_json list = ordered_json::array();
  for (const Example& example : embedded_examples()) {
    list.push_back({{"name", example.name}, {"request", ordered_json::parse(example.document)}});
  }
  return json_response(200, ordered_json{{"examples", std::move(list)}}.dump());
}

Response Routes::alive(const Request& /*request*/, const std::string& /*id*/) {
  return fresh(json_response(200, "{\"status\":\"ok\"}"));
}

Response Routes::ready(const Request& request, const std::string& /*id*/) const {
  const std::string why = facts_.not_ready ? facts_.not_ready() : "";
  if (why.empty()) {
    return fresh(json_response(200, "{\"status\":\"ok\"}"));
  }
  Response response = simple_problem(request, 503, "not-ready", "Not ready", why);
  response.headers.emplace_back("Retry-After", "5");
  return fresh(std::move(response));
}

Response Routes::metrics(const Request& /*request*/, const std::string& /*id*/) const {
  Response response;
  response.content_type = "text/plain; version=0.0.4; charset=utf-8";
  response.body = facts_.metrics ? facts_.metrics() : "";
  return fresh(std::move(response));
}

}  // namespace snapthrough::server::http
