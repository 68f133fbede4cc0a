#include "solver/discrete/structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "solver/mesh/dof_map.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {

std::vector<std::string> without_stiffness(const ResolvedModel& model) {
  std::vector<std::string> out;
  for (const ResolvedFoundation& foundation : model.foundations)
    if (initial_stiffness(foundation) == 0.0) out.push_back("foundation " + foundation.id + ": stiffness 0");
  for (const ResolvedSpring& spring : model.springs)
    if (initial_stiffness(spring) == 0.0) out.push_back("spring " + spring.id + ": stiffness 0");
  return out;
}

FoundationLaw law_on(const Structure& structure, const FoundationLaw& foundation, int element) {
  FoundationLaw law = foundation;
  if (law.law.one_sided && law.shear == 0.0) {
    const bool is_rigid = !std::isfinite(law.law.stiffness);
    law.stiffest =
        (is_rigid ? structure.stiffest_rigid : structure.stiffest)[static_cast<std::size_t>(element)];
    law.law.bound_stiffness(law.stiffest);
  }
  return law;
}

double length_of_element(const Structure& structure, int element) {
  const MeshElement& e = structure.mesh.elements[element];
  return (e.to - e.from) * structure.axes[e.member]->length() / structure.scales.length;
}

MeshPlace place_of(const Mesh& mesh, int member, double fraction) {
  const auto first = mesh.elements.begin() + mesh.first[member];
  const auto last = mesh.elements.begin() + mesh.first[member + 1];
  // the last element that begins at or before the place
  const auto next = std::partition_point(first + 1, last, [fraction](const MeshElement& element) {
    return element.from <= fraction + kOnePlace;
  });
  const int e = static_cast<int>(next - mesh.elements.begin()) - 1;
  const MeshElement& cell = mesh.elements[e];
  const double width = cell.to - cell.from;
  const double one = kOnePlace / width;
  const double xi = std::clamp((fraction - cell.from) / width, 0.0, 1.0);
  return {e, xi < one ? 0.0 : (xi > 1.0 - one ? 1.0 : xi)};
}

SparseRow displacement_row(const Structure& structure, const ResolvedLocation& at,
                           std::array<double, 3> row) {
  SparseRow out;
  const auto add = [&](Eigen::Index index, double weight) {
    if (weight != 0.0) out.entries.emplace_back(index, weight);
  };
  if (!at.is_on_member()) {
    const int node = at.node;
    for (int c = 0; c < 3; ++c) add(DofMap::first(node) + c, row[c]);
    return out;
  }
  const int member = at.member;
  const MeshPlace place = place_of(structure.mesh, member, at.fraction);
  const ElementDofs& dofs = structure.dofs[place.element];
  const MeshElement& cell = structure.mesh.elements[place.element];
  const double h = (cell.to - cell.from) * structure.axes[member]->length() / structure.scales.length;
  const int p = structure.mesh.order;
  std::array<double, kMaxOrder> a{};
  CollocationRule::of(p).integrals_at(place.xi, std::span(a).first(p));
  for (int c = 0; c < 3; ++c) {
    add(dofs.a[c], row[c]);
    for (int q = 0; q < p; ++q) add(dofs.v + c * p + q, row[c] * h * a[q]);
  }
  return out;
}

std::vector<MonitorRow> monitor_rows(const Structure& structure) {
  const ResolvedModel& model = *structure.model;
  std::vector<MonitorRow> out;
  for (const ResolvedMonitor& monitor : model.monitors) {
    std::array<double, 3> row{0.0, 0.0, 0.0};
    double unit = structure.scales.length;
    if (monitor.component == Component::x) row[0] = 1.0;
    if (monitor.component == Component::y) row[1] = 1.0;
    if (monitor.component == Component::rotation) {
      row[2] = 1.0;
      unit = 1.0;
    }
    if (monitor.component == Component::normal) {
      const AxisCurve& axis = *structure.axes[monitor.at.member];
      const double angle = axis.at(monitor.at.fraction * axis.length()).angle;
      row = {-std::sin(angle), std::cos(angle), 0.0};
    }
    MonitorRow& reading = out.emplace_back(monitor.id, displacement_row(structure, monitor.at, row));
    for (auto& [index, weight] : reading.row.entries) weight *= unit;
  }
  return out;
}

std::vector<FollowerForce> follower_forces_of(const Structure& structure) {
  const ResolvedModel& model = *structure.model;
  std::vector<FollowerForce> out;
  for (const Action& action : model.actions) {
    const auto* point = std::get_if<PointAction>(&action.what);
    if (point == nullptr || is_dead(*point) || structure.geometry == Geometry::linear) continue;
    FollowerForce& force = out.emplace_back();
    force.fixed_line = point->fixed_line;
    const bool grows = point->pattern == Pattern::proportional;
    for (std::size_t c = 0; c < 2; ++c)
      (grows ? force.proportional : force.constant)[c] =
          structure.scales.scaled_force(point->force[c]) / (grows ? structure.scales.load : 1.0);
    const auto along = [&](std::array<double, 3> row) {
      return displacement_row(structure, point->at, row).entries;
    };
    const auto x = along({1.0, 0.0, 0.0});
    const auto y = along({0.0, 1.0, 0.0});
    const auto turn = along({0.0, 0.0, 1.0});
    for (std::size_t i = 0; i < x.size(); ++i)
      force.terms.push_back({static_cast<int>(x[i].first), static_cast<int>(y[i].first),
                             static_cast<int>(turn[i].first), x[i].second});
  }
  return out;
}

NodeSpring rod_of(const Structure& structure, std::size_t index) {
  const ResolvedModel& model = *structure.model;
  const ResolvedSpring& spring = model.springs[index];
  return node_spring(structure.spring_laws[index], spring.at.node, spring.to->node);
}

SpringReading reading_of(const Structure& structure, std::size_t index, const Eigen::VectorXd& y) {
  const ResolvedModel& model = *structure.model;
  const ResolvedSpring& spring = model.springs[index];
  const SpringLaw& law = structure.spring_laws[index];
  SpringReading out;
  std::array<double, 3> row = law.row;
  if (law.cable) {
    const Eigen::Vector2d pull = law.cable->pull(rod_of(structure, index).ends(y)).force;
    out.force = pull.norm();
    const double tension = law.cable->force_at(pull, law.cable->tightest(pull)).norm();
    out.displacement = tension / law.cable->axial_stiffness() * law.length;
    row = {-pull[0] / out.force, -pull[1] / out.force, 0.0};
  } else if (spring.rod) {
    const SpringMotion motion = rod_of(structure, index).motion(y, structure.geometry == Geometry::linear);
    out.displacement = motion.w;
    row = {motion.gradient[0], motion.gradient[1], 0.0};
  }
  out.row = displacement_row(structure, spring.at, row);
  if (spring.to)
    for (const auto& [at, weight] : displacement_row(structure, *spring.to, row).entries)
      out.row.entries.emplace_back(at, -weight);
  if (law.cable) return out;
  if (law.ground >= 0)
    for (int c = 0; c < 3; ++c) out.row.entries.emplace_back(law.ground + c, -row[c]);
  if (law.without_force >= 0) out.row.entries.emplace_back(law.without_force, -law.sense);
  if (!spring.rod) out.displacement = out.row.dot(y);
  out.depth = out.displacement - law.law.gap;
  out.force = law.law.reaction(out.displacement);
  if (law.force_unknown < 0) return out;
  const double force = y[law.force_unknown];
  out.depth += (1.0 / law.law.stiffness - law.give) * force;
  out.force = out.depth > 0.0 ? force : 0.0;
  if (out.depth > 0.0) out.displacement = law.law.gap + law.give * force;
  return out;
}

namespace {

/// Scaled compliance of a section. That of a rigid one leaves strains that vanish beside the rounding of
/// others; section forces keep all digits, because the elements use its square root (element/element_work.h).
/// @param unit scaled stiffness one
double compliance_of(double unit, double stiffness) {
  constexpr double rigid = std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon();
  return std::isfinite(stiffness) ? unit / stiffness : rigid;
}

}  // namespace

ElementShape shape_of_element(const Structure& structure, int element) {
  const ResolvedModel& model = *structure.model;
  const MeshElement& e = structure.mesh.elements[element];
  const StressFreeAxis& axis = *structure.stress_free[e.member];
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const int section_index = model.members[e.member].section;
  const Section& section = model.sections[section_index];
  const double length = axis.perfect().length();
  const double L = structure.scales.length;
  const double F = structure.scales.force;
  ElementShape shape;
  const auto points = static_cast<std::size_t>(rule.order());
  shape.t.reserve(points);
  for (auto* list :
       {&shape.angle, &shape.axial_compliance, &shape.shear_compliance, &shape.bending_compliance})
    list->reserve(points);
  shape.length = (e.to - e.from) * length / L;
  shape.bending = structure.bending_curves[static_cast<std::size_t>(section_index)].get();
  std::array<double, 2> chord{0.0, 0.0};
  for (int q = 0; q < rule.order(); ++q) {
    const double fraction = e.from + rule.point(q) * (e.to - e.from);
    const StressFreePoint point = axis.at(length * fraction);
    shape.angle.push_back(point.angle);
    shape.t.push_back({point.stretch * std::cos(point.angle), point.stretch * std::sin(point.angle)});
    for (int c = 0; c < 2; ++c) chord[c] += rule.weight(q) * shape.t[q][c];
    shape.axial_compliance.push_back(compliance_of(point.stretch * F, section.EA.at(fraction)));
    shape.shear_compliance.push_back(section.GA ? point.stretch * F / section.GA->at(fraction) : 0.0);
    shape.bending_compliance.push_back(compliance_of(point.stretch * F * L * L, section.EI.at(fraction)));
  }
  // close the chord exactly, so that rigid motions are free of strain
  const StressFreePoint from = axis.at(length * e.from);
  const StressFreePoint to = axis.at(length * e.to);
  const std::array<double, 2> exact{(to.x - from.x) / L, (to.y - from.y) / L};
  for (auto& t : shape.t)
    for (int c = 0; c < 2; ++c) t[c] += exact[c] / shape.length - chord[c];
  return shape;
}

}  // namespace snapthrough
