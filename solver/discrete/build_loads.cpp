#include "solver/discrete/build_loads.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "solver/discrete/foundation_springs.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

/// Largest magnitude of a value that may vary along a member.
double largest_of(double constant, const Along<double>& along) {
  double largest = along.empty() ? std::abs(constant) : 0.0;
  for (const auto& point : along) largest = std::max(largest, std::abs(point.second));
  return largest;
}

}  // namespace

void LoadBuilder::add_all(std::optional<double> load_scale) {
  for (const Action& action : model_.actions)
    if (const auto* pressure = std::get_if<PressureAction>(&action.what)) add_pressure(*pressure);
  const bool known = like_ != nullptr && model_.actions == like_->model->actions;
  if (known) {
    out_.proportional_load = like_->proportional_load;
    out_.constant_load = like_->constant_load;
    if (like_->drawn_pull.size() > 0) out_.constant_load -= like_->drawn_pull;
  } else {
    for (const Action& action : model_.actions)
      std::visit([this](const auto& one) { add(one); }, action.what);
  }
  out_.scales.load = load_scale ? *load_scale : size_of_loads();
  if (!known) out_.proportional_load /= out_.scales.load;
  add_cables();
  scale_other_actions();
}

void LoadBuilder::add_cables() {
  if (std::ranges::none_of(out_.node_springs, &NodeSpring::is_cable)) return;
  out_.drawn_pull = Eigen::VectorXd::Zero(out_.size);
  for (const NodeSpring& spring : out_.node_springs) {
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    pull.head<2>() = spring.drawn_pull;
    if (spring.is_cable()) spring.add(pull, out_.drawn_pull);
  }
  out_.constant_load += out_.drawn_pull;
}

void LoadBuilder::add(const PointAction& load) {
  const Scales& scales = out_.scales;
  const std::array<double, 3> action{scales.scaled_force(load.force[0]), scales.scaled_force(load.force[1]),
                                     scales.scaled_moment(load.moment)};
  Eigen::VectorXd& loads = pattern(load.pattern);
  if (load.at.is_on_member()) {
    const MeshPlace place = place_of(out_.mesh, load.at.member, load.at.fraction);
    add_at(place.element, place.xi, action, loads);
  } else {
    DofMap::at(loads, load.at.node) += Eigen::Vector3d::Map(action.data());
  }
}

void LoadBuilder::add_at(int element, double xi, const std::array<double, 3>& action,
                         Eigen::VectorXd& load) const {
  const SupportSpring support = support_at(out_, element, xi, action);
  const ElementDofs& dofs = out_.dofs[element];
  const int p = out_.mesh.order;
  for (int c = 0; c < 3; ++c) {
    load[dofs.a[c]] += support.a[c];
    for (int q = 0; q < p; ++q) load[dofs.v + c * p + q] += support.v[q][c];
  }
}

void LoadBuilder::add(const LineAction& load) {
  const int member = load.member;
  const AxisCurve& axis = *out_.axes[member];
  const Quadrature gauss = gauss_legendre(out_.mesh.order + 1);
  for (const LinePiece& piece : load.pieces) {
    for (int e = out_.mesh.first[member]; e < out_.mesh.first[member + 1]; ++e) {
      const MeshElement& cell = out_.mesh.elements[e];
      const auto range = part_of(cell, piece.range);
      if (range[1] <= range[0]) continue;
      const double width = range[1] - range[0];
      for (std::size_t i = 0; i < gauss.points.size(); ++i) {
        const double xi = range[0] + width * gauss.points[i];
        const double fraction = cell.from + xi * (cell.to - cell.from);
        const double angle = axis.at(axis.length() * fraction).angle;
        const double w = length_of_element(out_, e) * width * out_.scales.scaled_line_load(gauss.weights[i]) *
                         measure_of(load.per, angle);
        const auto force = global_force(load.axes, piece.at(fraction), angle);
        add_at(e, xi, {w * force[0], w * force[1], 0.0}, pattern(load.pattern));
      }
    }
  }
}

void LoadBuilder::add_pressure(const PressureAction& load) {
  const int member = load.member;
  // a medium on the left pushes along the right normal
  const double sense = load.side == Side::left ? 1.0 : -1.0;
  const bool proportional = load.pattern == Pattern::proportional;
  const auto at = [&](double fraction) {
    return sense * out_.scales.scaled_line_load(value_at(load.value, load.value_along, fraction));
  };
  for (int e = out_.mesh.first[member]; e < out_.mesh.first[member + 1]; ++e) {
    const double from = at(out_.mesh.elements[e].from);
    const double to = load.value_along.empty() ? from : at(out_.mesh.elements[e].to);
    const LinePressure pressure{load.value_along.empty() ? from : 0.5 * (from + to), to - from};
    pressures_.push_back(
        {e, proportional ? pressure : LinePressure{}, proportional ? LinePressure{} : pressure});
  }
}

void LoadBuilder::add(const StrainAction& load) {
  const int member = load.member;
  const int p = out_.mesh.order;
  const Section& section = model_.sections[model_.members[member].section];
  const auto force_of = [](double strain, double stiffness) {
    return strain != 0.0 && std::isfinite(stiffness) ? strain * stiffness : 0.0;
  };
  if (load.pattern == Pattern::proportional)
    strain_size_ +=
        out_.scales.scaled_force(force_of(largest_of(load.axial, load.axial_along), section.EA.largest())) +
        out_.scales.scaled_moment(
            force_of(largest_of(load.curvature, load.curvature_along), section.EI.largest()));
  for (int e = out_.mesh.first[member]; e < out_.mesh.first[member + 1]; ++e) {
    const CollocationRule& rule = CollocationRule::of(p);
    const ElementShape shape = shape_of_element(out_, e);
    for (int q = 0; q < p; ++q) {
      const MeshElement& cell = out_.mesh.elements[e];
      const double fraction = cell.from + rule.point(q) * (cell.to - cell.from);
      const double length = shape.length * rule.weight(q) * std::hypot(shape.t[q][0], shape.t[q][1]);
      const double curvature = value_at(load.curvature, load.curvature_along, fraction);
      pattern(load.pattern)[out_.dofs[e].s + q] += length * value_at(load.axial, load.axial_along, fraction);
      pattern(load.pattern)[out_.dofs[e].s + 2 * p + q] += length * out_.scales.scaled_curvature(curvature);
    }
  }
}

/// Sum of the magnitudes of all actions at load factor one, by which the load factor is scaled.
double LoadBuilder::size_of_loads() const {
  double total = strain_size_;
  for (int j = 0; j < DofMap::count(out_.nodes) + out_.releases; ++j)
    total += std::abs(out_.proportional_load[j]);
  for (const ElementDofs& dofs : out_.dofs)
    if (dofs.a[0] >= DofMap::count(out_.nodes))
      for (const int i : dofs.a) total += std::abs(out_.proportional_load[i]);
  for (const NodeSupport& support : out_.supports)
    for (const double value : support.proportional) total += std::abs(value);
  for (const ElementPressure& p : pressures_)
    total += std::max(std::abs(p.proportional.at(0.0)), std::abs(p.proportional.at(1.0))) *
             length_of_element(out_, p.element);
  return total == 0.0 ? 1.0 : total;
}

/// Scales prescribed displacements and pressures.
void LoadBuilder::scale_other_actions() {
  const double total = out_.scales.load;
  for (NodeSupport& support : out_.supports)
    for (double& value : support.proportional) value /= total;
  for (const ElementPressure& p : pressures_)
    elements_.set_pressure(p.element, p.proportional.times(1.0 / total), p.constant);
  find_follower_ends(total);
  out_.follower_forces = follower_forces_of(out_);
}

/// Whether constant actions cause displacements, and not only reactions of rigid supports.
bool LoadBuilder::is_moved_by_constant_actions() const {
  for (const ElementPressure& p : pressures_)
    if (p.constant.acts()) return true;
  Eigen::VectorXd free = out_.constant_load;
  for (int node = 0; node < out_.nodes; ++node) {
    const NodeSupport& support = out_.supports[static_cast<std::size_t>(node)];
    if (support.constant != std::array<double, 3>{}) return true;
    Eigen::Vector2d along =
        Eigen::Rotation2Dd(-support.angle) * Eigen::Vector2d(DofMap::displacement(free, node));
    for (int c = 0; c < 2; ++c)
      if (support.fixed[c]) along[c] = 0.0;
    DofMap::displacement(free, node) = along;
    if (support.fixed[2]) free[DofMap::rotation(node)] = 0.0;
  }
  return free.lpNorm<Eigen::Infinity>() >
         Rounding::last_places * out_.constant_load.lpNorm<Eigen::Infinity>();
}

/// Adds the Gauss points of an element whose pressure changes.
void LoadBuilder::add_follower_changes(const ElementPressure& pressure, double load_scale) {
  if (pressure.proportional.change == 0.0 && pressure.constant.change == 0.0) return;
  const ElementDofs& dofs = out_.dofs[pressure.element];
  const CollocationRule& rule = CollocationRule::of(out_.mesh.order);
  const int p = rule.order();
  for (int q = 0; q < p; ++q) {
    FollowerEnd& point = out_.follower_ends.emplace_back();
    point.terms.push_back({dofs.a[0], dofs.a[1]});
    for (int r = 0; r < p; ++r)
      point.terms.push_back(
          {dofs.v + r, dofs.v + p + r, length_of_element(out_, pressure.element) * rule.integral(q, r)});
    const double weight = -0.5 * rule.weight(q);
    point.proportional = weight * pressure.proportional.change / load_scale;
    point.constant = weight * pressure.constant.change;
  }
}

/// Finds movable nodes where the pressures of the adjacent lines do not cancel.
void LoadBuilder::find_follower_ends(double load_scale) {
  std::vector<FollowerEnd> sums(static_cast<std::size_t>(out_.nodes));
  for (const ElementPressure& p : pressures_) {
    const ElementDofs& dofs = out_.dofs[p.element];
    for (const auto& [node, half] : {std::pair{dofs.a, -0.5}, std::pair{dofs.b, 0.5}}) {
      if (node[0] >= DofMap::first(out_.first_stop_node)) continue;
      FollowerEnd& end = sums[DofMap::node(node[0])];
      end.proportional += half * p.proportional.at(0.5 + half) / load_scale;
      end.constant += half * p.constant.at(0.5 + half);
    }
    if (out_.geometry == Geometry::nonlinear) add_follower_changes(p, load_scale);
  }
  for (int j = 0; j < out_.nodes && out_.geometry == Geometry::nonlinear; ++j) {
    const NodeSupport& support = out_.supports[j];
    sums[j].terms = {{DofMap::first(j), DofMap::first(j) + 1}};
    if (!support.fixed[0] && !support.fixed[1] && (sums[j].proportional != 0.0 || sums[j].constant != 0.0))
      out_.follower_ends.push_back(sums[j]);
  }
}

}  // namespace snapthrough
