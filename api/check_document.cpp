#include "api/check_document.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "solver/mesh/given_elements.h"
#include "solver/mesh/mesh.h"
#include "solver/support/rods.h"

namespace snapthrough::api {
namespace {

using nlohmann::ordered_json;

/// Largest number of points that are read to find a valid request.
constexpr std::uint64_t kTries = 10;

/// Elements of a mesh, and their order.
struct MeshSize {
  int elements = 0;
  int order = 1;
};

/// Counts a given mesh without making it; one that the program chooses is made, since its size follows from
/// the model.
MeshSize mesh_size(const Model& model, const Discretization& asked) {
  if (!asked.fixed_mesh) {
    const Mesh mesh = make_mesh(model, asked, make_axes(model));
    return {static_cast<int>(mesh.elements.size()), mesh.order};
  }
  return {static_cast<int>(given_elements(model, asked)), asked.order};
}

/// Returns the number of free displacement unknowns of the request's mesh, before any refinement.
int unknowns_of(const Request& request) {
  const Model model = rods_as_springs(request.model);
  const MeshSize mesh = mesh_size(model, request.analysis.discretization);
  // A member of n elements of order p has n p - 1 inner nodes with three displacements each.
  int unknowns = 3 * static_cast<int>(model.nodes.size());
  unknowns += 3 * (mesh.elements * mesh.order - static_cast<int>(model.members.size()));
  for (const Member& member : model.members) {
    unknowns += (member.release_start_rotation ? 1 : 0) + (member.release_end_rotation ? 1 : 0);
  }
  for (const Support& support : model.supports) {
    unknowns -= (support.x ? 1 : 0) + (support.y ? 1 : 0) + (support.rotation ? 1 : 0);
  }
  return unknowns;
}

}  // namespace

CheckedDocument check_request(const std::shared_ptr<const nlohmann::json>& document,
                              const AlsoRefused& also) {
  ReadOutcome read = read_request_document(document);
  if (!read.request) {
    return {std::move(read.findings), 1, 0};
  }
  return {also ? also(*read.request) : std::vector<Finding>(), 1, unknowns_of(*read.request)};
}

CheckedDocument check_sweep(const std::shared_ptr<const nlohmann::json>& document, std::uint64_t most_points,
                            const AlsoRefused& also) {
  SweepOutcome read = read_sweep_document(document, most_points);
  CheckedDocument checked{std::move(read.findings), read.sweep ? read.sweep->size() : 0, 0};
  for (std::uint64_t i = 0; i < std::min(checked.points, kTries) && checked.unknowns == 0; ++i) {
    checked.unknowns = check_request(read.sweep->document_at(i), also).unknowns;
  }
  return checked;
}

std::string write_check(const CheckedDocument& checked) {
  ordered_json document{
      {"valid", checked.findings.empty()}, {"errors", write_findings(checked.findings)}, {"size", nullptr}};
  if (checked.findings.empty()) {
    document["size"] = {{"points", checked.points}, {"unknowns", checked.unknowns}};
  }
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace snapthrough::api
