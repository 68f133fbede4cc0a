#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "api/api.h"
#include "api/names.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

// to_json(x): one function a type. Optional values that are empty, and counts that were not filled, are null.

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class T>
Json count_or_null(T count) {
  return count < 0 ? Json(nullptr) : Json(count);
}

template <class T>
Json write(const std::vector<std::optional<T>>& values) {
  Json array = Json::array();
  for (const std::optional<T>& value : values) {
    array.push_back(or_null(value));
  }
  return array;
}

Json write(const Mode& mode) {
  Json members = Json::object();
  for (const MemberMode& member : mode.members) {
    members[member.id] = {{"s", member.s}, {"u", member.u}, {"v", member.v}, {"rotation", member.rotation}};
  }
  return {{"members", std::move(members)}};
}

Json write(const std::optional<Softest>& softest) {
  if (!softest) {
    return nullptr;
  }
  return {{"load_factor", softest->load_factor},
          {"stiffness_ratio", softest->stiffness_ratio},
          {"mode", softest->mode ? write(*softest->mode) : Json(nullptr)}};
}

Json write(const std::optional<AtCritical>& at) {
  if (!at) {
    return nullptr;
  }
  return {{"displacement", at->displacement},
          {"relative_displacement", at->relative_displacement},
          {"rotation", at->rotation},
          {"strain", at->strain}};
}

Json write(const Summary& summary) {
  return {{"critical_load_factor", or_null(summary.critical_load_factor)},
          {"critical_type",
           summary.critical_type ? Json(name_of(kCriticalTypes, *summary.critical_type)) : Json(nullptr)},
          {"error_estimate", or_null(summary.error_estimate)},
          {"softest", write(summary.softest)},
          {"at_critical", write(summary.at_critical)},
          {"termination", summary.termination},
          {"message", summary.message}};
}

Json write(const std::vector<NamedValue>& values) {
  Json object = Json::object();
  for (const NamedValue& value : values) {
    object[value.id] = value.value;
  }
  return object;
}

Json write(const std::vector<NamedSeries>& series) {
  Json object = Json::object();
  for (const NamedSeries& one : series) {
    object[one.id] = one.values;
  }
  return object;
}

Json write(const std::vector<MeshAnswer>& meshes) {
  Json array = Json::array();
  for (const MeshAnswer& mesh : meshes) {
    array.push_back(
        {{"elements", mesh.elements}, {"order", mesh.order}, {"load_factor", or_null(mesh.load_factor)}});
  }
  return array;
}

Json write(const std::vector<Sensitivity>& sensitivities) {
  Json array = Json::array();
  for (const Sensitivity& one : sensitivities) {
    array.push_back({{"pointer", one.pointer},
                     {"derivative", or_null(one.derivative)},
                     {"reason", one.reason ? Json(name_of(kNoDerivatives, *one.reason)) : Json(nullptr)}});
  }
  return array;
}

Json write(const std::optional<KoiterCoefficients>& koiter) {
  if (!koiter) {
    return nullptr;
  }
  return {{"a", koiter->a}, {"b", or_null(koiter->b)}, {"kind", name_of(kBifurcationKinds, koiter->kind)}};
}

Json write(const CriticalPoint& point) {
  Json out{{"branch", point.branch},
           {"type", name_of(kCriticalTypes, point.type)},
           {"cause", name_of(kCriticalCauses, point.cause)},
           {"load_factor", point.load_factor},
           {"error_estimate", or_null(point.error_estimate)},
           {"confirmed", point.confirmed},
           {"meshes", write(point.meshes)},
           {"arc_length", point.arc_length},
           {"monitors", write(point.monitors)},
           {"negative_before", count_or_null(point.negative_before)},
           {"negative_after", count_or_null(point.negative_after)},
           {"multiplicity", point.multiplicity},
           {"imperfection", or_null(point.imperfection)},
           {"state", or_null(point.state)},
           {"member", or_null(point.member)},
           {"mode", point.mode ? write(*point.mode) : Json(nullptr)}};
  if (!point.sensitivities.empty()) {
    out["sensitivities"] = write(point.sensitivities);
  }
  return out;
}

Json write(const NeutralMotion& motion) {
  Json nodes = Json::object();
  for (const NodeMotion& node : motion.nodes) {
    nodes[node.node] = {{"u", node.u}, {"v", node.v}, {"rotation", node.rotation}};
  }
  return {{"branch", motion.branch},
          {"from", motion.from},
          {"to", or_null(motion.to)},
          {"nodes", std::move(nodes)}};
}

Json write(const ContactEvent& event) {
  return {{"branch", event.branch},
          {"id", event.id},
          {"type", event.opened ? "opened" : "closed"},
          {"load_factor", event.load_factor},
          {"arc_length", event.arc_length},
          {"zones_before", event.zones_before},
          {"zones_after", event.zones_after}};
}

Json write(const Branch& branch) {
  return {{"id", branch.id},
          {"parent", or_null(branch.parent)},
          {"load_factor", branch.load_factor},
          {"arc_length", branch.arc_length},
          {"monitors", write(branch.monitors)},
          {"negative_eigenvalues", branch.negative_eigenvalues},
          {"stiffness_ratio", write(branch.stiffness_ratio)},
          {"contact_fraction", write(branch.contact_fraction)},
          {"termination", branch.termination}};
}

Json write(const Resultant& resultant) {
  return {{"fx", resultant.fx}, {"fy", resultant.fy}, {"moment", resultant.moment}};
}

Json write(const MemberState& member) {
  return {{"s", member.s},
          {"x0", member.x0},
          {"y0", member.y0},
          {"x", member.x},
          {"y", member.y},
          {"u", member.u},
          {"v", member.v},
          {"rotation", member.rotation},
          {"axial_force", member.axial_force},
          {"shear_force", member.shear_force},
          {"bending_moment", member.bending_moment}};
}

Json write(const FoundationState& foundation) {
  return {{"s", foundation.s},
          {"reaction", foundation.reaction},
          {"displacement", foundation.displacement},
          {"contact", foundation.contact},
          {"resultant", write(foundation.resultant)}};
}

Json write(const SpringState& spring) {
  return {{"force", spring.force},
          {"displacement", spring.displacement},
          {"closed", spring.closed},
          {"resultant", write(spring.resultant)}};
}

Json write(const State& state) {
  Json members = Json::object();
  for (const MemberState& member : state.members) {
    members[member.id] = write(member);
  }
  Json supports = Json::object();
  for (const SupportState& support : state.supports) {
    supports[support.node] = {{"fx", support.fx}, {"fy", support.fy}, {"moment", support.moment}};
  }
  Json springs = Json::object();
  for (const SpringState& spring : state.springs) {
    springs[spring.id] = write(spring);
  }
  Json foundations = Json::object();
  for (const FoundationState& foundation : state.foundations) {
    foundations[foundation.id] = write(foundation);
  }
  return {{"branch", state.branch},
          {"load_factor", state.load_factor},
          {"refinements", state.refinements},
          {"members", std::move(members)},
          {"supports", std::move(supports)},
          {"springs", std::move(springs)},
          {"foundations", std::move(foundations)},
          {"loads", write(state.loads)}};
}

Json write(const StaticTable& table) {
  return {{"load_factor", table.load_factor},
          {"monitors", write(table.monitors)},
          {"negative_eigenvalues", write(table.negative_eigenvalues)},
          {"contact_fraction", write(table.contact_fraction)},
          {"state", write(table.state)}};
}

Json write(const Extreme& extreme) {
  return {{"value", extreme.value},
          {"s", extreme.s},
          {"branch", extreme.branch},
          {"load_factor", extreme.load_factor}};
}

Json write(const ExtremeRange& range) { return {{"min", write(range.min)}, {"max", write(range.max)}}; }

Json write(const std::vector<MemberExtremes>& extremes) {
  Json members = Json::object();
  for (const MemberExtremes& member : extremes) {
    members[member.id] = {{"axial_force", write(member.axial_force)},
                          {"shear_force", write(member.shear_force)},
                          {"bending_moment", write(member.bending_moment)},
                          {"displacement", {{"max", write(member.displacement)}}}};
  }
  return {{"members", std::move(members)}};
}

Json write(const Warning& warning) { return {{"code", warning.code}, {"detail", warning.detail}}; }

template <class T>
Json write_all(const std::vector<T>& items) {
  Json array = Json::array();
  for (const T& item : items) {
    array.push_back(write(item));
  }
  return array;
}

Json write(const MeshReport& mesh) {
  return {
      {"elements", count_or_null(mesh.elements)},
      {"order", count_or_null(mesh.order)},
      {"unknowns", count_or_null(mesh.unknowns)},
      {"refinements", count_or_null(mesh.refinements)},
      {"paths", mesh.paths},
      {"accuracy",
       {{"requested", or_null(mesh.requested_accuracy)}, {"estimated", or_null(mesh.estimated_accuracy)}}}};
}

Json write(const Diagnostics& diagnostics, double wall_time_s) {
  return {{"steps", count_or_null(diagnostics.steps)},
          {"rejected_steps", count_or_null(diagnostics.rejected_steps)},
          {"iterations", count_or_null(diagnostics.iterations)},
          {"factorizations", count_or_null(diagnostics.factorizations)},
          {"max_relative_residual", count_or_null(diagnostics.max_relative_residual)},
          {"wall_time_s", wall_time_s},
          {"skipped", diagnostics.skipped}};
}

Json write(const Model& model) {
  Json units = Json::object();
  for (const auto& [quantity, unit] : model.units) {
    units[quantity] = unit;
  }
  return {{"title", model.title}, {"units", std::move(units)}};
}

/// JSON has no NaN and no infinity, and the library would write null without a word. Depth is that of the
/// contract.
void require_finite_numbers(const Json& json, const std::string& pointer) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) {
    throw std::runtime_error("the result has a number that is not finite at " + pointer);
  }
  if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      if (json[i].is_structured() || json[i].is_number_float()) {
        require_finite_numbers(json[i], pointer + "/" + std::to_string(i));
      }
    }
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      require_finite_numbers(value, pointer + "/" + key);
    }
  }
}

}  // namespace

nlohmann::json write_result(const Request& request, const Result& result, double wall_time_s,
                            std::span<const std::string_view> parts) {
  Json document = Json::object();
  const auto add = [&](std::string_view part, const auto& make) {
    if (parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end()) {
      document.emplace(part, make());
    }
  };
  add("model", [&] { return write(request.model); });
  add("summary", [&] { return write(result.summary); });
  add("critical_points", [&] {
    Json points = write_all(result.critical_points);
    for (std::size_t i = 0; request.analysis.koiter && i < points.size(); ++i) {
      points[i]["koiter"] = write(result.critical_points[i].koiter);
    }
    return points;
  });
  add("neutral_motion", [&] { return write_all(result.neutral_motion); });
  add("contact_events", [&] { return write_all(result.contact_events); });
  add("branches", [&] { return write_all(result.branches); });
  add("states", [&] { return write_all(result.states); });
  add("not_reached", [&] { return Json(result.not_reached); });
  add("warnings", [&] { return write_all(result.warnings); });
  add("discretization", [&] { return write(result.discretization); });
  add("diagnostics", [&] { return write(result.diagnostics, wall_time_s); });
  if (result.buckling) {
    add("buckling", [&] {
      return Json{{"load_factors", result.buckling->load_factors},
                  {"error_estimates", write(result.buckling->error_estimates)},
                  {"modes", write_all(result.buckling->modes)}};
    });
  }
  if (result.static_table) {
    add("static", [&] { return write(*result.static_table); });
  }
  if (result.extremes) {
    add("extremes", [&] { return write(*result.extremes); });
  }
  if (result.failure) {
    add("failure", [&] { return Json{{"code", result.failure->code}, {"detail", result.failure->detail}}; });
  }
  require_finite_numbers(document, "");
  return document;
}

nlohmann::json write_findings(const std::vector<Finding>& findings) {
  Json array = Json::array();
  for (const Finding& finding : findings) {
    array.push_back({{"pointer", finding.pointer}, {"code", finding.code}, {"detail", finding.detail}});
  }
  return array;
}

}  // namespace snapthrough::api
