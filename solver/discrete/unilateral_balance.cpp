#include "solver/discrete/unilateral_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "solver/discrete/places_on_axis.h"
#include "solver/discrete/rigid_loads.h"
#include "solver/numeric/dense.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/nonnegative_least_squares.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Row = RigidParts::Row;

/// Numbers of the balance of loads on one-sided supports. Source: docs/decisions/0018.
struct BalanceLimits {
  /// Least share of the loads on a group that each independent support must be able to carry; loads closer to
  /// the limit of equilibrium count as not held. Far above rounding, far below the accuracy of any load.
  static constexpr double margin = 1e-8;
  /// Residual over the load below which pressures balance it: some thousand roundings, far below the margin.
  static constexpr double residual = 1e-12;
  static constexpr double uncoupled = 1e-9;    ///< cosine between two supports' rows that are uncoupled
  static constexpr double first_load = 1e-6;   ///< proportional over constant actions: a very small load
  static constexpr double load_width = 1e-11;  ///< relative width of the final bracket of the limit load
  static constexpr int rounds = 100;           ///< times that places of curved supports are added, at most
  /// Displacement into a support (a cosine) that is allowed: this share of the residual, within the bounds.
  static constexpr double entered_share = 1e-3;
  static constexpr double least_entered = 1e-13;  ///< lower bound: rounding
  static constexpr double most_entered = 1e-8;    ///< upper bound
};

void append(const VectorXd& column, MatrixXd& matrix) {
  matrix.conservativeResize(column.size(), matrix.cols() + 1);
  matrix.rightCols(1) = column;
}

}  // namespace

bool UnilateralBalance::Forces::vanish() const { return sum.norm() <= Rounding::motion * size; }

UnilateralBalance::UnilateralBalance(const FreeMotions& motions) : motions_(motions) {
  if (motions.empty()) return;
  for (const ResolvedSpring& spring : motions.joined_model().springs)
    if (is_one_sided(spring)) add(spring);
  for (const ResolvedFoundation& foundation : motions.joined_model().foundations)
    if (is_one_sided(foundation)) add(foundation);
  close_groups();
  add_loads();
}

VectorXd UnilateralBalance::on_motions(const Row& row) const {
  VectorXd out = VectorXd::Zero(motions_.motions().cols());
  for (const auto& [unknown, weight] : row) out += weight * motions_.motions().row(unknown).transpose();
  return out;
}

/// Normalised row on the free motions; empty when they do not move the support.
std::optional<VectorXd> UnilateralBalance::unit_row(const Row& row) const {
  double size = 0.0;
  for (const auto& [unknown, weight] : row) size += std::abs(weight);
  VectorXd out = on_motions(row);
  const double norm = out.norm();
  if (!(norm > Rounding::motion * size)) return std::nullopt;
  return out / norm;
}

void UnilateralBalance::add(const ResolvedSpring& spring) {
  Row row = motions_.parts().displacement(spring);
  for (auto& [unknown, weight] : row) weight *= sense_of(spring.reaction);
  add_support({row}, nullptr);
}

Row UnilateralBalance::row_at(const CurvedSupport& support, double fraction) const {
  const AxisPoint at = motions_.parts().place(support.member, fraction);
  return motions_.parts().displacement(support.member, {at.x, at.y},
                                       support.law.initial_direction({{at.x, at.y}, at.angle, fraction}));
}

void UnilateralBalance::add(const ResolvedFoundation& foundation) {
  const int member = foundation.member;
  const CurvedSupport whole{member, foundation.range, motions_.parts().law(foundation)};
  const auto [from, to] = foundation.range;
  std::vector<Row> rows{row_at(whole, from), row_at(whole, to)};
  if (motions_.parts().axes()[static_cast<std::size_t>(member)]->straight() && !foundation.outline) {
    add_support(rows, nullptr);
    return;
  }
  for (const double point : gauss_legendre(MechanismLimits::places_on_curve).points)
    rows.push_back(row_at(whole, from + point * (to - from)));
  add_support(rows, &whole);
}

/// Adds a support's rows to their group; merges groups that the rows couple.
void UnilateralBalance::add_support(const std::vector<Row>& rows, const CurvedSupport* curved) {
  Group joined;
  joined.rows.resize(motions_.motions().cols(), 0);
  for (const Row& row : rows)
    if (const auto unit = unit_row(row)) append(*unit, joined.rows);
  if (joined.rows.cols() == 0) return;
  if (curved != nullptr) joined.curved.push_back(*curved);
  MatrixXd span = joined.rows;
  int absorbed = 0;
  for (auto group = groups_.begin(); group != groups_.end();) {
    const MatrixXd common = group->basis.transpose() * joined.rows;
    if (common.lpNorm<Eigen::Infinity>() <= BalanceLimits::uncoupled) {
      ++group;
      continue;
    }
    ++absorbed;
    const bool spans =
        (joined.rows - group->basis * common).lpNorm<Eigen::Infinity>() <= BalanceLimits::uncoupled;
    if (absorbed == 1 && spans) {  // the usual case: no other group is coupled
      MatrixXd both(joined.rows.rows(), group->rows.cols() + joined.rows.cols());
      both << group->rows, joined.rows;
      group->rows = std::move(both);
      group->curved.insert(group->curved.end(), joined.curved.begin(), joined.curved.end());
      return;
    }
    MatrixXd both(span.rows(), span.cols() + group->basis.cols());
    both << span, group->basis;
    span = std::move(both);
    MatrixXd all(span.rows(), joined.rows.cols() + group->rows.cols());
    all << joined.rows, group->rows;
    joined.rows = std::move(all);
    joined.curved.insert(joined.curved.end(), group->curved.begin(), group->curved.end());
    group = groups_.erase(group);
  }
  joined.basis = orthonormal_span(span, BalanceLimits::uncoupled);
  groups_.push_back(std::move(joined));
}

void UnilateralBalance::close_groups() {
  for (Group& group : groups_) {
    group.rows = (group.basis.transpose() * group.rows).colwise().normalized().eval();
    const MatrixXd independent = independent_columns(group.rows, BalanceLimits::uncoupled);
    group.inside = independent.rowwise().sum() / static_cast<double>(independent.cols());
  }
}

void UnilateralBalance::add_loads() {
  const Index unknowns = motions_.motions().rows();
  const std::vector<LoadWork> works = works_of_loads(motions_.parts());
  for (Group& group : groups_) {
    MatrixXd seen = motions_.motions() * group.basis;  // work of unit forces per unknown
    seen = (seen.array().abs() > Rounding::motion).select(seen, 0.0).eval();
    const VectorXd weights = seen.rowwise().norm();
    VectorXd constant = VectorXd::Zero(unknowns);
    VectorXd proportional = VectorXd::Zero(unknowns);
    for (const LoadWork& load : works) {
      const bool is_constant = load.pattern == Pattern::constant;
      VectorXd& forces = is_constant ? constant : proportional;
      double& size = is_constant ? group.constant.size : group.proportional.size;
      for (const auto& [unknown, force] : load.row) {
        forces[unknown] += force;
        size += std::abs(force) * weights[unknown];
      }
    }
    group.constant.sum = seen.transpose() * constant;
    group.proportional.sum = seen.transpose() * proportional;
  }
}

bool UnilateralBalance::is_proportional() const {
  return std::all_of(groups_.begin(), groups_.end(),
                     [](const Group& group) { return group.constant.vanish(); });
}

std::optional<VectorXd> UnilateralBalance::row_in(const Group& group, const CurvedSupport& support,
                                                  double fraction) const {
  const auto unit = unit_row(row_at(support, fraction));
  if (!unit) return std::nullopt;
  const VectorXd out = group.basis.transpose() * *unit;
  return out / out.norm();
}

/// Adds, for each curved support, the rows at the maxima of a motion's displacement into the support.
/// @param tolerance displacement (a cosine) that counts as zero
/// @return false when the motion enters no support
bool UnilateralBalance::add_entered(const Group& group, const VectorXd& motion, double tolerance,
                                    MatrixXd& rows) const {
  const Index before = rows.cols();
  for (const CurvedSupport& support : group.curved) {
    const AxisCurve& axis = *motions_.parts().axes()[static_cast<std::size_t>(support.member)];
    const auto entered = [&](double fraction) {
      const auto row = row_in(group, support, fraction);
      return row ? row->dot(motion) : 0.0;
    };
    for (const double at : places_of_maxima(axis, support.range, entered))
      if (entered(at) > tolerance) append(*row_in(group, support, at), rows);
  }
  return rows.cols() > before;
}

namespace {

/// Direction of a residual, re-orthogonalised to the rows with pressure, because a small residual has few
/// accurate digits.
VectorXd off_pressed(const MatrixXd& rows, const NonnegativeSolution& found) {
  std::vector<Index> pressed;
  for (Index j = 0; j < found.x.size(); ++j)
    if (found.x[j] > 0.0) pressed.push_back(j);
  const VectorXd direction = found.residual.normalized();
  if (pressed.empty()) return direction;
  const MatrixXd A = rows(Eigen::all, pressed);
  return VectorXd(direction - A * least_squares(A, direction)).normalized();
}

}  // namespace

/// Direction of the part of a force that the supports of a group cannot balance: length one, entering no
/// support; empty when they balance the force.
/// @param force zero: tests whether positive pressures can be in equilibrium by themselves
/// @param margin share of the force that each independent support must be able to carry
std::optional<VectorXd> UnilateralBalance::unbalanced(const Group& group, const VectorXd& force,
                                                      double margin) const {
  const double size = force.norm();
  const VectorXd wanted =
      size > 0.0 ? VectorXd(force / size - margin * group.inside) : VectorXd(-group.inside.normalized());
  MatrixXd rows = group.rows;
  NonnegativeSolution found;
  for (int round = 0; round < BalanceLimits::rounds; ++round) {
    found = nonnegative_least_squares(rows, wanted);
    const double left = found.residual.norm();
    if (left <= (size > 0.0 ? BalanceLimits::residual : BalanceLimits::uncoupled)) return std::nullopt;
    const double tolerance =
        std::max(std::min(BalanceLimits::entered_share * left, BalanceLimits::most_entered),
                 BalanceLimits::least_entered);
    if (!add_entered(group, found.residual / left, tolerance, rows)) break;
  }
  return off_pressed(rows, found);
}

std::optional<Escape> UnilateralBalance::escape_of(const Group& group, const ActionFactors& actions,
                                                   double margin) const {
  const double constant = actions.constant;
  const double proportional = actions.proportional;
  Forces force{constant * group.constant.sum + proportional * group.proportional.sum,
               std::abs(constant) * group.constant.size + std::abs(proportional) * group.proportional.size};
  if (force.vanish()) force.sum.setZero();
  const auto direction = unbalanced(group, force.sum, margin);
  if (!direction) return std::nullopt;
  Escape out;
  out.motion = motions_.motions() * (group.basis * *direction);
  out.driven = force.sum.dot(*direction) > BalanceLimits::margin * force.sum.norm();
  out.actions = actions;
  return out;
}

std::optional<Escape> UnilateralBalance::escape_with(double factor, double margin) const {
  std::optional<Escape> first;
  for (const Group& group : groups_) {
    const bool unloaded = group.constant.vanish();
    if (unloaded && factor == 0.0) continue;
    auto found = escape_of(group, {unloaded ? 0.0 : 1.0, factor}, margin);
    if (found && (!first || (found->driven && !first->driven))) first = std::move(found);
  }
  return first;
}

std::optional<Escape> UnilateralBalance::escape(double factor) const {
  return escape_with(factor, BalanceLimits::margin);
}

std::optional<Escape> UnilateralBalance::escape_at_start(double direction) const {
  std::optional<Escape> first;
  for (const Group& group : groups_) {
    ActionFactors actions{0.0, direction};
    if (!group.constant.vanish()) {
      const double proportional = group.proportional.vanish() ? 0.0 : group.proportional.sum.norm();
      actions = {1.0, proportional > 0.0
                          ? direction * BalanceLimits::first_load * group.constant.sum.norm() / proportional
                          : 0.0};
    }
    auto found = escape_of(group, actions, BalanceLimits::margin);
    if (found && (!first || (found->driven && !first->driven))) first = std::move(found);
  }
  return first;
}

double UnilateralBalance::largest_held(double held, double beyond) const {
  while (std::abs(beyond - held) > BalanceLimits::load_width * std::abs(beyond)) {
    const double middle = 0.5 * (held + beyond);
    if (middle == held || middle == beyond) break;
    (escape_with(middle, 0.0) ? beyond : held) = middle;
  }
  return held;
}

}  // namespace snapthrough
