#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/api.h"
#include "api/openapi/document.h"
#include "api/sweep.h"
#include "server/jobs/envelope.h"
#include "server/jobs/large_document.h"
#include "server/jobs/least_memory.h"
#include "server/resources/embedded.h"
#include "server/resources/routes.h"
#include "solver/mesh/mesh.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::ordered_json;

/// Free displacement unknowns of the mesh that a request asks for, before any refinement.
int unknowns_of(const api::Request& request) {
  const Model& model = request.model;
  const Mesh mesh = make_mesh(model, request.analysis.discretization, make_axes(model));
  // A member of n elements of order p has n p - 1 places inside, and all places have three displacements.
  int unknowns = 3 * static_cast<int>(model.nodes.size());
  unknowns +=
      3 * (static_cast<int>(mesh.elements.size()) * mesh.order - static_cast<int>(model.members.size()));
  for (const Member& member : model.members) {
    unknowns += (member.release_start_rotation ? 1 : 0) + (member.release_end_rotation ? 1 : 0);
  }
  for (const Support& support : model.supports) {
    unknowns -= (support.x ? 1 : 0) + (support.y ? 1 : 0) + (support.rotation ? 1 : 0);
  }
  return unknowns;
}

/// What is wrong with a document, and how large it is.
struct Checked {
  std::vector<Finding> findings;
  std::uint64_t points = 1;
  int unknowns = 0;
};

/// @param memory bytes that an analysis may use
Checked checked_request(const std::shared_ptr<const nlohmann::json>& document, std::int64_t memory) {
  api::ReadOutcome read = api::read_request_document(document);
  if (!read.request) {
    return {std::move(read.findings), 1, 0};
  }
  return {check_memory(read.request->model, read.request->analysis, memory), 1, unknowns_of(*read.request)};
}

/// Unknowns are those of the first point that is a valid request.
Checked checked_sweep(const std::shared_ptr<const nlohmann::json>& document, const JobLimits& limits) {
  constexpr std::uint64_t kTries = 10;
  api::SweepOutcome read =
      api::read_sweep_document(document, static_cast<std::uint64_t>(limits.sweep_points));
  Checked checked{std::move(read.findings), read.sweep ? read.sweep->size() : 0, 0};
  for (std::uint64_t i = 0; i < std::min(checked.points, kTries) && checked.unknowns == 0; ++i) {
    checked.unknowns = checked_request(read.sweep->document_at(i), limits.job_memory).unknowns;
  }
  return checked;
}

/// A document with or without an envelope, of either kind.
Envelope opened(std::string_view body, const std::vector<std::string>& callback_hosts) {
  Envelope envelope = open_envelope(body, "request", callback_hosts);
  const bool sweep = envelope.document != nullptr && envelope.pointer.empty() &&
                     envelope.document->is_object() && envelope.document->contains("sweep");
  return sweep ? open_envelope(body, "sweep", callback_hosts) : envelope;
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
  const Envelope envelope = opened(request.body, jobs_.limits().callback_hosts);
  if (envelope.malformed) {
    return problem_response({400, "malformed-json", "Malformed JSON", "The body is no acceptable JSON text.",
                             envelope.findings, "", ""},
                            request);
  }
  const bool sweep = envelope.pointer == "/sweep" || api::is_sweep(*envelope.document);
  Checked checked = sweep ? checked_sweep(envelope.document, jobs_.limits())
                          : checked_request(envelope.document, jobs_.limits().job_memory);
  checked.findings = in_envelope(envelope, std::move(checked.findings));
  ordered_json document{{"valid", checked.findings.empty()},
                        {"errors", api::write_findings(checked.findings)},
                        {"size", nullptr}};
  if (checked.findings.empty()) {
    document["size"] = {{"points", checked.points}, {"unknowns", checked.unknowns}};
  }
  return json_response(200, document.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
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

Response Routes::ready(const Request& request, const std::string& /*id*/) {
  const std::string why = facts_.not_ready ? facts_.not_ready() : "";
  if (why.empty()) {
    return fresh(json_response(200, "{\"status\":\"ok\"}"));
  }
  Response response = simple_problem(request, 503, "not-ready", "Not ready", why);
  response.headers.emplace_back("Retry-After", "5");
  return fresh(std::move(response));
}

Response Routes::metrics(const Request& /*request*/, const std::string& /*id*/) {
  Response response;
  response.content_type = "text/plain; version=0.0.4; charset=utf-8";
  response.body = facts_.metrics ? facts_.metrics() : "";
  return fresh(std::move(response));
}

}  // namespace snapthrough::server::http
