#include "solver/problem/structural_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/mesh/dof_map.h"
#include "solver/numeric/cancelled.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Relative residual, by rounding, of supports too stiff for double. Source: docs/decisions/0022.
constexpr double kMostRounding = 1e-7;

}  // namespace

StructuralProblem::StructuralProblem(const Structure& structure)
    : structure_(structure),
      stop_(structure.stop),
      elements_(structure.elements->make_work()),
      springs_(structure.node_springs),
      joints_(structure.joints),
      axes_(structure),
      scales_(structure, *elements_),
      nodes_(structure, axes_),
      follower_loads_(structure.follower_ends, structure.follower_forces),
      condensed_(structure.dofs.size()) {}

void StructuralProblem::add_node_springs(const VectorXd& y, const Regime& regime, VectorXd& f) {
  springs_.evaluate(y, regime);
  springs_.add_forces(f);
  joints_.evaluate(y, regime);
  joints_.add_moments(f);
}

void StructuralProblem::force_along(const VectorXd& motion, VectorXd& out) const {
  out.setZero(size());
  out.head(motion.size()) = motion;
  axes_.to_supports(out);
}

void StructuralProblem::metric_forces(const Eigen::Ref<const VectorXd>& x, Eigen::Ref<VectorXd> out) const {
  out = structure_.metric.cwiseProduct(x);
  axes_.release(out);
}

void StructuralProblem::set_holds(const SharedHolds& holds) {
  if (holds == holds_) return;
  holds_ = holds;
  nodes_.set_holds(holds);
}

void StructuralProblem::add_holds(const VectorXd& y, VectorXd& f) const {
  if (!holds_) return;
  const Index rows = holds_->motions.rows();
  const VectorXd moved = holds_->motions.transpose() * y.head(rows) - holds_->at;
  f.head(rows) += holds_->stiffness * (holds_->motions * moved);
}

/// Turns the rows of nodes to the axes of supports and replaces the constrained rows by the constraints.
void StructuralProblem::constrain_residual(const VectorXd& y, double lambda, VectorXd& f) const {
  axes_.to_supports(f);
  const auto [proportional, constant] = factors(lambda);
  for (const Index row : axes_.fixed()) {
    const int node = static_cast<int>(DofMap::node(row));
    const Index k = DofMap::component(row);
    const NodeSupport& support = structure_.supports[node];
    f[row] = axes_.components(y, node)[k] - proportional * support.proportional[k] -
             constant * support.constant[k];
  }
}

/// Starts the residual with minus the loads at points and along members.
void StructuralProblem::start_residual(const VectorXd& y, double lambda, const Regime& regime,
                                       VectorXd& f) const {
  const auto [proportional, constant] = factors(lambda);
  f = -proportional * structure_.proportional_load - constant * structure_.constant_load;
  if (!regime.small_displacements) follower_loads_.add_load(y, {-proportional, -constant}, f);
}

Regime StructuralProblem::regime_of(const Regime& asked) const {
  Regime regime = asked;
  regime.small_displacements = asked.small_displacements || structure_.geometry == Geometry::linear;
  return regime;
}

void StructuralProblem::find_residual(const VectorXd& y, double lambda, const Regime& asked, VectorXd& f) {
  end_if_asked(stop_);
  const Regime regime = regime_of(asked);
  start_residual(y, lambda, regime, f);
  elements_->add_residual(y, factors(lambda), regime, f);
  add_node_springs(y, regime, f);
  add_holds(y, f);
  constrain_residual(y, lambda, f);
}

void StructuralProblem::load(const VectorXd& y, double, VectorXd& out) {
  const bool constant = stage_ == Stage::constant;
  out = constant ? structure_.constant_load : structure_.proportional_load;
  elements_->add_pressure_load(y, factor_rates(), structure_.geometry == Geometry::linear, out);
  follower_loads_.add_load(y, factor_rates(), out);
  axes_.to_supports(out);
  for (const Index row : axes_.fixed()) {
    const NodeSupport& support = structure_.supports[DofMap::node(row)];
    out[row] = (constant ? support.constant : support.proportional)[DofMap::component(row)];
  }
}

TangentReport StructuralProblem::factorise(const VectorXd& y, double lambda, const Regime& asked,
                                           VectorXd& f) {
  end_if_asked(stop_);
  const Regime regime = regime_of(asked);
  start_residual(y, lambda, regime, f);
  elements_->linearise(y, factors(lambda), regime, f, condensed_);
  add_node_springs(y, regime, f);
  add_holds(y, f);
  TangentReport report = nodes_.factorise(condensed_, springs_, joints_);
  corrected_ = !follower_loads_.empty() && !regime.small_displacements;
  add_couplings(report);
  if (corrected_) add_follower_loads(y, lambda, report);
  constrain_residual(y, lambda, f);
  return report;
}

/// Corrects determinant and count of the tangent without couplings between elements.
void StructuralProblem::add_couplings(TangentReport& report) {
  couplings_.prepare(elements_->couplings(), size(), [this](const Eigen::Ref<MatrixXd>& x) {
    to_rows(x);
    solve_uncoupled(x);
  });
  report.negative -= couplings_.negative();
  report.log_abs_det += couplings_.log_abs_det();
}

/// Corrects determinant and count of the symmetric part for the follower loads. A nonsymmetric tangent
/// changes its divergence stability where its determinant changes sign; the count is changed to match that
/// parity.
void StructuralProblem::add_follower_loads(const VectorXd& y, double lambda, TangentReport& report) {
  const double det = follower_loads_.prepare(y, factors(lambda), [this](const Eigen::Ref<MatrixXd>& x) {
    to_rows(x);
    solve_symmetric(x);
  });
  report.log_abs_det += std::log(std::max(std::abs(det), std::numeric_limits<double>::min()));
  if (det < 0.0) report.negative += report.negative > 0 ? -1 : 1;
  report.parity_only = true;
}

void StructuralProblem::solve(Eigen::Ref<MatrixXd> x) {
  solve_symmetric(x);
  if (!corrected_) return;
  for (Index i = 0; i < x.cols(); ++i) follower_loads_.correct(x.col(i));
}

/// Moves what prescribed displacements of the ground do to the elements to the right-hand sides.
void StructuralProblem::subtract_ground(Eigen::Ref<MatrixXd> x) const {
  const Index first = DofMap::first(structure_.first_ground);
  const Index count = DofMap::count(structure_.first_stop_node - structure_.first_ground);
  VectorXd forces;
  for (Index i = 0; count > 0 && i < x.cols(); ++i) {
    if ((x.col(i).segment(first, count).array() == 0.0).all()) continue;
    forces.setZero(size());
    elements_->add_ground_forces(x.col(i).data(), forces.data());
    axes_.release(forces);
    x.col(i) -= forces;
  }
}

void StructuralProblem::solve_symmetric(Eigen::Ref<MatrixXd> x) {
  solve_uncoupled(x);
  for (Index i = 0; i < x.cols() && !couplings_.empty(); ++i) couplings_.correct(x.col(i));
}

void StructuralProblem::solve_uncoupled(const Eigen::Ref<MatrixXd>& x) {
  subtract_ground(x);
  nodes_.solve(*elements_, x);
}

/// Relative residual that half a unit in the last place of the displacements leaves at the stiffest support.
double StructuralProblem::residual_rounding(const VectorXd& y, double lambda) const {
  const double largest = std::max({elements_->support_rounding(), springs_.rounding(y), joints_.rounding(y)});
  const double force = scales_.reference(y, factors(lambda));
  return force > 0.0 ? std::min(0.5 * largest / force, kMostRounding) : 0.0;
}

Eigen::MatrixXd StructuralProblem::find_products(const VectorXd& y, double lambda, const Regime& asked,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& directions) {
  end_if_asked(stop_);
  const Regime regime = regime_of(asked);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(y.size(), directions.cols());
  elements_->add_tangent_products(y, factors(lambda), regime, directions, products);
  springs_.evaluate(y, regime);
  joints_.evaluate(y, regime);
  for (Index i = 0; i < directions.cols(); ++i)
    add_node_products(y, lambda, regime, directions.col(i), products.col(i));
  return products;
}

/// Dead loads and constraints have constant tangents; the ends of pressed lines follow the load factor.
MatrixXd StructuralProblem::tangent_change(const VectorXd& y, double lambda, const PathDirection& along,
                                           const Eigen::Ref<const MatrixXd>& motions) {
  end_if_asked(stop_);
  MatrixXd change = MatrixXd::Zero(motions.rows(), motions.cols());
  const auto [proportional, constant] = factor_rates();
  const LoadFactors rates{along.lambda * proportional, along.lambda * constant};
  elements_->add_tangent_changes(y, rates, regime_of({}), along.y, motions, change);
  for (Index i = 0; i < change.cols(); ++i) {
    springs_.add_changes(y, structure_.geometry == Geometry::linear, along.y, motions.col(i), change.col(i));
    joints_.add_changes(y, along.y, motions.col(i), change.col(i));
    follower_loads_.add_change(y, factors(lambda), rates, along.y, motions.col(i), change.col(i));
    axes_.release(change.col(i));
  }
  return change;
}

VectorXd StructuralProblem::load_change(const VectorXd& y, double, const PathDirection& along) {
  VectorXd change = VectorXd::Zero(y.size());
  if (structure_.geometry == Geometry::linear) return change;
  const auto [proportional, constant] = factor_rates();
  elements_->add_pressure_change({proportional, constant}, along.y, change);
  follower_loads_.add_product(y, {-proportional, -constant}, along.y, change);
  axes_.release(change);
  return change;
}

/// Adds the tangent times `direction`, without the elements' part, in the row order of linearise().
void StructuralProblem::add_node_products(const VectorXd& y, double lambda, const Regime& regime,
                                          const Eigen::Ref<const VectorXd>& direction,
                                          Eigen::Ref<VectorXd> out) const {
  if (!regime.small_displacements) follower_loads_.add_product(y, factors(lambda), direction, out);
  springs_.add_products(direction, out);
  joints_.add_products(direction, out);
  if (holds_) {
    const Eigen::MatrixXd& H = holds_->motions;
    out.head(H.rows()) += holds_->stiffness * (H * (H.transpose() * direction.head(H.rows())));
  }
  axes_.to_supports(out);
  for (const Index row : axes_.fixed())
    out[row] = axes_.components(direction, static_cast<int>(DofMap::node(row)))[DofMap::component(row)];
}

}  // namespace snapthrough
