#include "solver/events/buckling_pencil.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/mesh/dof_map.h"
#include "solver/newton/contact_state.h"
#include "solver/newton/corrector.h"
#include "solver/problem/held_motions.h"

namespace snapthrough {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Stiffness or displacement of a pinned motion that counts as zero, scaled.
constexpr double kIdle = 1e-6;

}  // namespace

/// Frozen contact of the reference load, with laws linearised there; the default regime for structures with
/// linear, bilateral supports only.
Regime BucklingPencil::regime() const {
  Regime regime;
  if (!structure_.traits.one_sided && !structure_.traits.changing_stiffness) return regime;
  regime.contact = Regime::Contact::frozen;
  regime.frozen = &contact_;
  return regime;
}

Regime BucklingPencil::regime_at(double lambda) {
  Regime out = regime();
  if (!structure_.traits.one_sided) return out;
  prestress_ = constant_ + sense_ * lambda * proportional_;
  out.prestress = &prestress_;
  return out;
}

/// Linear response to the actions of a stage, from the unloaded state.
VectorXd BucklingPencil::linear_response(StructuralProblem::Stage stage, double lambda, Regime regime) {
  regime.small_displacements = true;
  problem_.set_stage(stage);
  const VectorXd y = VectorXd::Zero(problem_.size());
  VectorXd residual;
  problem_.linearise(y, 0.0, residual, regime);
  ++factorizations_;
  VectorXd response;
  problem_.load(y, 0.0, response);
  response *= lambda;
  problem_.solve(response);
  drop_rounding(std::abs(lambda) * problem_.least_force(), response);
  problem_.set_stage(StructuralProblem::Stage::proportional);
  return response;
}

/// Sets all section forces to zero if none exceeds `least`. Actions that meet no resistance leave section
/// forces of rounding size, which would give spurious buckling loads.
void BucklingPencil::drop_rounding(double least, VectorXd& response) const {
  const int p = structure_.mesh.order;
  double largest = 0.0;
  for (const ElementDofs& dofs : structure_.dofs)
    largest = std::max(largest, response.segment(dofs.s, DofMap::count(p)).lpNorm<Eigen::Infinity>());
  if (largest > least) return;
  for (const ElementDofs& dofs : structure_.dofs) response.segment(dofs.s, DofMap::count(p)).setZero();
}

bool BucklingPencil::holds_are_idle(double lambda) {
  if (!holds_) return true;
  ++factorizations_;
  const double bound = kIdle * std::max(1.0, std::abs(lambda));
  const MotionStiffness held =
      motion_stiffness(problem_, holds_, stress(lambda), sense_ * lambda, regime_at(lambda));
  const VectorXd moved = holds_->motions.transpose() *
                         (constant_ + sense_ * lambda * proportional_).head(holds_->motions.rows());
  return held.stiffness.lpNorm<Eigen::Infinity>() <= bound && moved.lpNorm<Eigen::Infinity>() <= bound;
}

/// Equilibrium with small displacements under the constant actions and a load factor, with unilateral contact
/// and laws as they are, from the bilateral response; empty when it was not found.
std::optional<VectorXd> BucklingPencil::state_at(double load) {
  Regime bilateral;
  bilateral.contact = Regime::Contact::bilateral;
  VectorXd y = linear_response(StructuralProblem::Stage::constant, 1.0, bilateral) +
               linear_response(StructuralProblem::Stage::proportional, load, bilateral);
  const PathMetric metric{&structure_.metric, 0.0};
  const double size = metric.norm(y, 0.0);
  if (!(size > 0.0)) return y;
  CorrectorOptions options;
  options.max_iterations = 60;
  options.largest_correction = std::numeric_limits<double>::infinity();
  options.regime.small_displacements = true;
  Workspace work;
  double lambda = load;
  const auto converges = [&](double scale) {
    const CorrectorOutcome outcome = correct(problem_, metric, {}, scale, options, y, lambda, work);
    factorizations_ += outcome.factorisations;
    return outcome.status == CorrectorStatus::converged;
  };
  if (converges(size)) return y;
  const auto state = find_contact_state(problem_, metric, load, work, factorizations_, nullptr, true);
  if (!state) return std::nullopt;
  y = state->y;
  // the state is exact to five digits, which is enough for its contact
  if (!structure_.traits.changing_stiffness || converges(metric.norm(y, 0.0))) return y;
  return state->y;
}

/// Stores the contact of the state under the reference load; false when there is none.
bool BucklingPencil::freeze_contact(double load) {
  const std::optional<VectorXd> y = state_at(load);
  if (!y) return false;
  contact_ = problem_.contact().frozen(*y, true);
  if (structure_.traits.changing_stiffness) contact_.linearised_at = *y;
  marks_ = problem_.contact().marks_at(*y, true);
  return true;
}

/// Sets the stresses of both kinds of actions where laws have a curve: those of the state under the reference
/// load are the sum, so that reactions on a plateau count. False when the constant actions have no state.
bool BucklingPencil::set_curved_prestress(double load) {
  constant_ = VectorXd::Zero(problem_.size());
  if (structure_.has_constant) {
    const std::optional<VectorXd> alone = state_at(0.0);
    if (!alone) return false;
    constant_ = *alone;
  }
  // the stored state is that of soft holds on motions without stiffness
  const std::optional<VectorXd> loaded = holds_ ? state_at(load) : contact_.linearised_at;
  if (!loaded) return false;
  proportional_ = (*loaded - constant_) / load;
  drop_rounding(problem_.least_force(), proportional_);
  return true;
}

bool BucklingPencil::set_prestress(double reference) {
  const SharedHolds soft = held_softly(problem_);
  problem_.set_holds(soft);
  const double load = sense_ * reference;
  if ((structure_.traits.one_sided || structure_.traits.changing_stiffness) && !freeze_contact(load))
    return false;
  if (soft) {
    Regime small = regime();
    small.small_displacements = true;
    holds_ = softly_held(problem_, soft, VectorXd::Zero(problem_.size()), 0.0, small).neutral;
    ++factorizations_;
    problem_.set_holds(holds_);
  }
  if (structure_.traits.has_curves) return set_curved_prestress(load);
  constant_ = linear_response(StructuralProblem::Stage::constant, 1.0, regime());
  proportional_ = linear_response(StructuralProblem::Stage::proportional, 1.0, regime());
  return true;
}

VectorXd BucklingPencil::stress(double lambda) const {
  VectorXd y = VectorXd::Zero(problem_.size());
  const int p = structure_.mesh.order;
  for (const ElementDofs& dofs : structure_.dofs)
    y.segment(dofs.s, DofMap::count(p)) = constant_.segment(dofs.s, DofMap::count(p)) +
                                          sense_ * lambda * proportional_.segment(dofs.s, DofMap::count(p));
  return y;
}

int BucklingPencil::factorise(double lambda) {
  VectorXd residual;
  ++factorizations_;
  factorised_ = lambda;
  return problem_.linearise(stress(lambda), sense_ * lambda, residual, regime_at(lambda)).negative;
}

void BucklingPencil::to_global(MatrixXd& rows) const {
  for (int j = 0; j < structure_.nodes; ++j) {
    const double angle = structure_.supports[j].angle;
    if (angle == 0.0) continue;
    const Eigen::Rotation2Dd turn(angle);
    rows.middleRows(DofMap::first(j), 2) = turn.toRotationMatrix() * rows.middleRows(DofMap::first(j), 2);
  }
}

MatrixXd BucklingPencil::weighted(const MatrixXd& x) {
  MatrixXd out = is_stable_at_start_ ? products(0.0, x)
                                     : problem_.tangent_products(VectorXd::Zero(x.rows()), 0.0, x, regime());
  to_global(out);
  return out;
}

MatrixXd BucklingPencil::apply(const MatrixXd& x, const MatrixXd& weighted) {
  MatrixXd forces = products(factorised_, x);
  to_global(forces);
  if (is_stable_at_start_) {
    forces = (weighted - forces) / factorised_;
  } else {
    MatrixXd at_start = products(0.0, x);
    to_global(at_start);
    forces = (at_start - forces) / factorised_;
  }
  return response(std::move(forces));
}

MatrixXd BucklingPencil::response(MatrixXd forces) {
  problem_.to_rows(forces);
  problem_.solve(forces);
  return forces;
}

MatrixXd BucklingPencil::works(const MatrixXd& x) {
  MatrixXd forces = products(0.0, x);
  to_global(forces);
  return x.transpose() * forces;
}

MatrixXd BucklingPencil::geometric(const MatrixXd& x) {
  MatrixXd out = products(1.0, x) - products(0.0, x);
  to_global(out);
  return out;
}

double BucklingPencil::quotient(const VectorXd& x) {
  const VectorXd elastic = products(0.0, x);
  const VectorXd geometric = products(1.0, x) - elastic;
  return -problem_.work(elastic, x) / problem_.work(geometric, x);
}

}  // namespace snapthrough
