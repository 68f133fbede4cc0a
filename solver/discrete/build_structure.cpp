#include "solver/discrete/build_structure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "solver/discrete/build_loads.h"
#include "solver/discrete/build_supports.h"
#include "solver/discrete/build_unknowns.h"
#include "solver/discrete/mass_matrix.h"
#include "solver/discrete/mechanism.h"
#include "solver/discrete/stops.h"
#include "solver/discrete/structure_laws.h"
#include "solver/geometry/axes.h"
#include "solver/geometry/stress_free_axis.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/resolve/rods.h"
#include "solver/support/joined_supports.h"

namespace snapthrough {
namespace {

/// Sets the scales, and numbers the nodes. @param known scales of another mesh or model; null: from the model
void set_scales(const Scales* known, Structure& out) {
  const ResolvedModel& model = *out.model;
  double length = 0.0;
  double bending = 0.0;
  for (const auto& axis : out.axes) length = std::max(length, axis->length());
  for (const ResolvedMember& member : model.members)
    if (const double EI = model.sections[member.section].EI.largest(); std::isfinite(EI))
      bending = std::max(bending, EI);
  if (model.members.empty()) length = longest_rod(model.springs);
  if (bending == 0.0)  // nothing bends: the stiffness of rods at that length is the unit of forces
    for (const ResolvedSpring& spring : model.springs)
      if (spring.rod) bending = std::max(bending, spring.stiffness * std::pow(length, 3));
  out.scales.length = length;
  out.scales.force = bending / (length * length);
  if (known != nullptr) out.scales = *known;
  number_nodes(out);
}

void set_metric(Structure& out) {
  out.metric = Eigen::VectorXd::Zero(out.size);
  const CollocationRule& rule = CollocationRule::of(out.mesh.order);
  const int p = rule.order();
  double total = 0.0;
  for (std::size_t e = 0; e < out.dofs.size(); ++e) total += length_of_element(out, static_cast<int>(e));
  for (const NodeSpring& spring : out.node_springs) total += spring.length;
  for (const NodeSpring& spring : out.node_springs)
    for (int c = 0; spring.is_rod() && c < 2; ++c)
      for (const int node : {spring.node, spring.to})
        out.metric[DofMap::first(node) + c] += 0.5 * spring.length / total;
  for (std::size_t e = 0; e < out.dofs.size(); ++e) {
    const ElementDofs& dofs = out.dofs[e];
    const double part = length_of_element(out, static_cast<int>(e)) / total;
    for (int c = 0; c < 2; ++c) {
      out.metric[dofs.a[c]] += 0.5 * part;
      out.metric[dofs.b[c]] += 0.5 * part;
      for (int q = 0; q < p; ++q) out.metric[dofs.v + c * p + q] = part * rule.weight(q);
    }
  }
}

/// Sets the loads at which members buckle, see Structure::euler_loads and Structure::foundation_loads.
void set_critical_loads(Structure& out) {
  const ResolvedModel& model = *out.model;
  // a rigid member counts with the stiffest of the others
  const double stiffest = out.scales.force * out.scales.length * out.scales.length;
  const auto finite = [stiffest](double EI) { return std::isfinite(EI) ? EI : stiffest; };
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const double length = out.axes[m]->length();
    out.euler_loads.push_back(std::numbers::pi * std::numbers::pi *
                              finite(model.section_of(model.members[m]).EI.least()) /
                              (length * length * out.scales.force));
  }
  out.foundation_loads.assign(model.members.size(), 0.0);
  for (const ResolvedFoundation& foundation : model.foundations) {
    const auto m = static_cast<std::size_t>(foundation.member);
    const double EI = finite(model.section_of(model.members[m]).EI.largest());
    const double stiffness = stiffness_on(out, foundation, foundation.member);
    out.foundation_loads[m] += foundation.component == FoundationComponent::rotation
                                   ? stiffness
                                   : 2.0 * std::sqrt(stiffness * EI) + foundation.shear_stiffness;
  }
  for (double& load : out.foundation_loads) load /= out.scales.force;
}

/// Number of displacements that no support holds, those between and inside elements included.
int free_displacements_of(const Structure& out) {
  const int p = out.mesh.order;
  int free = DofMap::count(out.nodes) + out.releases;
  for (const NodeSupport& support : out.supports)
    for (const bool fixed : support.fixed) free -= fixed ? 1 : 0;
  // add the nodes between elements, and the P - 1 interior nodes of each element of order P
  for (std::size_t m = 0; m + 1 < out.mesh.first.size(); ++m) {
    const int n = out.mesh.first[m + 1] - out.mesh.first[m];
    free += DofMap::count(n - 1 + (p - 1) * n);
  }
  return free;
}

/// Opposite supports of which one always acts are bilateral together, and follower pressures that cancel each
/// other at the ends of their lines have a potential.
ModelTraits traits_of(const Structure& structure) {
  const auto one_sided = [](const auto& support) { return is_one_sided(support); };
  const ResolvedModel& laws = *structure.laws;
  ModelTraits out;
  out.one_sided =
      std::ranges::any_of(laws.foundations, one_sided) || std::ranges::any_of(laws.springs, one_sided);
  out.has_curves =
      !structure.curves.empty() ||
      std::ranges::any_of(structure.bending_curves, [](const auto& curve) { return curve != nullptr; });
  out.changing_stiffness =
      out.has_curves || std::ranges::any_of(structure.foundation_laws, &FoundationLaw::follows_surface);
  out.symmetric = structure.follower_ends.empty() && structure.follower_forces.empty();
  out.has_mass = has_mass(*structure.model);
  out.loose = structure.geometry == Geometry::nonlinear && is_loose(*structure.model);
  return out;
}

/// Makes the curves of the sections' bending laws. An element that is like one of `like` refers to its curve.
void set_bending_curves(const Structure* like, Structure& out) {
  const std::vector<Section>& sections = out.model->sections;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const bool is_known =
        like != nullptr && i < like->bending_curves.size() && like->model->sections[i] == sections[i];
    out.bending_curves.push_back(is_known ? like->bending_curves[i]
                                          : bending_curve_of(sections[i], out.scales));
  }
}

/// Fills all data that follow from the model, the axes, the geometry and the mesh, which are already set.
/// @param scales null: computed from the model
/// @param like null, or a structure with the same mesh, axes and scales, whose parts are taken over where
/// they do not differ
void fill(const Scales* scales, const Structure* like, Structure& out) {
  const ResolvedModel& model = *out.model;
  std::optional<ResolvedModel> joined = with_joined_supports(model);
  out.laws = joined ? std::make_shared<const ResolvedModel>(*std::move(joined)) : out.model;
  const ResolvedModel& laws = *out.laws;
  set_scales(scales, out);
  std::vector<SpringLaw> springs;
  std::vector<FoundationLaw> foundations;
  add_laws(model.springs, model.foundations, out, out.spring_laws, out.foundation_laws);
  add_laws(laws.springs, laws.foundations, out, springs, foundations);
  const auto keep = [&out](const auto& law) {
    if (law.curve) out.curves.push_back(law.curve);
  };
  std::ranges::for_each(foundations, keep);
  std::ranges::for_each(springs, keep);
  set_bending_curves(like, out);
  bound_stiffness(out);
  number_unknowns(springs, out);
  SupportBuilder supports(foundations, springs, like, out);
  std::unique_ptr<ElementSet> elements = supports.make_elements();
  supports.add_at_nodes();
  LoadBuilder loads(like, *elements, out);
  loads.add_all(scales != nullptr ? std::optional(scales->load) : std::nullopt);
  set_metric(out);
  out.monitors = monitor_rows(out);
  out.elements = std::move(elements);
  out.traits = traits_of(out);
  out.has_constant = loads.is_moved_by_constant_actions();
  set_critical_loads(out);
  out.free_displacements = free_displacements_of(out);
}

void set_axes(const ModeOffsets& modes, Structure& out) {
  const ResolvedModel& model = *out.model;
  out.axes = make_axes(model);
  out.origin = {model.nodes.front().x, model.nodes.front().y};
  for (std::size_t m = 0; m < model.members.size(); ++m)
    out.stress_free.push_back(std::make_shared<const StressFreeAxis>(
        model, static_cast<int>(m), out.axes[m], modes.empty() ? std::vector<CubicSpline>{} : modes[m]));
}

}  // namespace

Structure make_structure(ResolvedModel model, const Discretization& discretization, Geometry geometry,
                         const ModeOffsets& modes, MeshUse use) {
  Structure out;
  out.model = std::make_shared<const ResolvedModel>(std::move(model));
  out.geometry = geometry;
  set_axes(modes, out);
  out.mesh = make_mesh(*out.model, discretization, out.axes, use);
  fill(nullptr, nullptr, out);
  return out;
}

namespace {

/// Structure of a model on a mesh, with axes and scales of another one.
Structure built_anew(const Structure& structure, std::shared_ptr<const ResolvedModel> model, Mesh mesh,
                     TouchingSupports touching, const Structure* like) {
  Structure out;
  out.model = std::move(model);
  out.geometry = structure.geometry;
  out.axes = structure.axes;
  out.origin = structure.origin;
  out.stress_free = structure.stress_free;
  out.mesh = std::move(mesh);
  out.touching = std::move(touching);
  fill(&structure.scales, like, out);
  out.free_motions = structure.free_motions;
  out.stop = structure.stop;
  return out;
}

/// Whether both models have the same axes, perfect and stress-free. @param modes see with_changed_model()
bool has_same_axes(const ResolvedModel& a, const ResolvedModel& b, const ModeOffsets& modes) {
  return modes.empty() && a.nodes == b.nodes && a.members == b.members && a.imperfections == b.imperfections;
}

}  // namespace

Structure on_mesh(const Structure& structure, Mesh mesh) {
  return built_anew(structure, structure.model, std::move(mesh), structure.touching, nullptr);
}

Structure with_touching(const Structure& structure, TouchingSupports touching) {
  return built_anew(structure, structure.model, structure.mesh, std::move(touching), &structure);
}

Structure with_changed_model(const Structure& structure, ResolvedModel changed, const ModeOffsets& modes) {
  const ResolvedModel& model = *structure.model;
  if (has_same_axes(model, changed, modes)) {
    Mesh mesh = moved_mesh(structure.mesh, model, structure.axes, changed, structure.axes);
    const bool same = mesh.elements == structure.mesh.elements;
    return built_anew(structure, std::make_shared<const ResolvedModel>(std::move(changed)), std::move(mesh),
                      structure.touching, same ? &structure : nullptr);
  }
  Structure out;
  out.model = std::make_shared<const ResolvedModel>(std::move(changed));
  out.geometry = structure.geometry;
  set_axes(modes, out);
  out.mesh = moved_mesh(structure.mesh, model, structure.axes, *out.model, out.axes);
  out.touching = structure.touching;
  fill(&structure.scales, nullptr, out);
  out.free_motions = structure.free_motions;
  out.stop = structure.stop;
  return out;
}

}  // namespace snapthrough
