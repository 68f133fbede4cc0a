#include "solver/discrete/given_state.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "solver/geometry/cubic_spline.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/gauss_rule.h"

namespace snapthrough {
namespace {

/// Source: digits of published and stored results.
struct GivenStateLimits {
  static constexpr double reached = 1e-6;  ///< distance to a stop that acts, over the largest displacement
};

/// Splines through the scaled values of one member over the scaled arc length.
struct MemberSplines {
  double length = 0.0;
  std::array<CubicSpline, 3> displacement;
  std::array<CubicSpline, 3> force;
};

MemberSplines splines_of(const Structure& structure, int member, const MemberShape& shape) {
  const Scales& scales = structure.scales;
  const auto scaled = [](std::vector<double> values, double unit) {
    for (double& value : values) value /= unit;
    return values;
  };
  const std::vector<double> s = scaled(shape.s, scales.length);
  const double moment = scales.force * scales.length;
  return {structure.axes[static_cast<std::size_t>(member)]->length() / scales.length,
          {CubicSpline(s, scaled(shape.u, scales.length)), CubicSpline(s, scaled(shape.v, scales.length)),
           CubicSpline(s, shape.rotation)},
          {CubicSpline(s, scaled(shape.axial, scales.force)),
           CubicSpline(s, scaled(shape.shear, scales.force)), CubicSpline(s, scaled(shape.bend, moment))}};
}

void set_element(const Structure& structure, const MemberSplines& member, int element, Eigen::VectorXd& y) {
  const MeshElement& cell = structure.mesh.elements[static_cast<std::size_t>(element)];
  const ElementDofs& dofs = structure.dofs[static_cast<std::size_t>(element)];
  const int p = structure.mesh.order;
  const CollocationRule& rule = CollocationRule::of(p);
  for (int c = 0; c < 3; ++c) {
    const CubicSpline& u = member.displacement[static_cast<std::size_t>(c)];
    const CubicSpline& n = member.force[static_cast<std::size_t>(c)];
    y[dofs.a[c]] = u.at(cell.from * member.length)[0];
    y[dofs.b[c]] = u.at(cell.to * member.length)[0];
    for (int q = 0; q < p; ++q) {
      const double s = (cell.from + rule.point(q) * (cell.to - cell.from)) * member.length;
      y[dofs.v + c * p + q] = u.at(s)[1];
      y[dofs.s + c * p + q] = n.at(s)[0];
    }
  }
}

/// Lets the stops act that the members reach; equations linear in their forces then give these.
void set_stops(const Structure& structure, Eigen::VectorXd& y) {
  const ResolvedModel& model = *structure.model;
  const double largest = y.head(DofMap::count(structure.nodes)).lpNorm<Eigen::Infinity>();
  for (std::size_t i = 0; structure.stops > 0 && i < model.springs.size(); ++i) {
    const SpringLaw& law = structure.spring_laws[i];
    if (law.force_unknown >= 0 && reading_of(structure, i, y).depth > -GivenStateLimits::reached * largest)
      y[law.force_unknown] = law.law.stiffness * largest;
  }
}

}  // namespace

Eigen::VectorXd unknowns_of(const Structure& structure, const StartState& state) {
  const ResolvedModel& model = *structure.model;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(structure.size);
  const auto shape_of = [&state](const std::string& id) -> const MemberShape& {
    const auto shape = std::find_if(state.members.begin(), state.members.end(),
                                    [&id](const MemberShape& one) { return one.id == id; });
    if (shape == state.members.end()) throw std::invalid_argument("a member has no shape");
    return *shape;
  };
  // nodes that only rods reach
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    if (!model.springs[i].rod) continue;
    const MemberShape& shape = shape_of(model.springs[i].id);
    const NodeSpring rod = rod_of(structure, i);
    for (const auto& [node, at] : {std::pair{rod.node, std::size_t{0}}, {rod.to, shape.s.size() - 1}}) {
      DofMap::displacement(y, node) << shape.u[at] / structure.scales.length,
          shape.v[at] / structure.scales.length;
    }
  }
  std::vector<MemberSplines> members;
  for (std::size_t m = 0; m < model.members.size(); ++m)
    members.push_back(splines_of(structure, static_cast<int>(m), shape_of(model.members[m].id)));
  for (std::size_t e = 0; e < structure.mesh.elements.size(); ++e)
    set_element(structure, members[static_cast<std::size_t>(structure.mesh.elements[e].member)],
                static_cast<int>(e), y);
  set_stops(structure, y);
  return y;
}

}  // namespace snapthrough
