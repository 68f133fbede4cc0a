#include "solver/events/buckling_pencil.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/newton/contact_state.h"
#include "solver/newton/corrector.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Stiffness or displacement of a pinned motion that counts as zero, scaled.
constexpr double kIdle = 1e-6;

}  // namespace

/// Frozen contact of the reference load, with laws linearised there; the default regime for structures with
/// linear, bilateral supports only.
Regime BucklingPencil::regime() const {
  Regime regime;
  if (!structure_.one_sided && !structure_.curved()) return regime;
  regime.contact = Regime::Contact::frozen;
  regime.frozen = &contact_;
  return regime;
}

Regime BucklingPencil::regime_at(double lambda) {
  Regime out = regime();
  if (!structure_.one_sided) return out;
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
    largest = std::max(largest, response.segment(dofs.s, 3 * p).lpNorm<Eigen::Infinity>());
  if (largest > least) return;
  for (const ElementDofs& dofs : structure_.dofs) response.segment(dofs.s, 3 * p).setZero();
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

/// Solves for the equilibrium under both kinds of actions with unilateral contact, from the bilateral
/// response, and stores its contact; false when it was not found.
bool BucklingPencil::freeze_contact(double reference) {
  Regime glued;
  glued.contact = Regime::Contact::bilateral;
  VectorXd y = linear_response(StructuralProblem::Stage::constant, 1.0, glued) +
               linear_response(StructuralProblem::Stage::proportional, reference, glued);
  const PathMetric metric{&structure_.metric, 0.0};
  const double size = metric.norm(y, 0.0);
  if (size > 0.0) {
    CorrectorOptions options;
    options.max_iterations = 60;
    options.largest_correction = std::numeric_limits<double>::infinity();
    options.regime.small_displacements = true;
    Workspace work;
    double lambda = reference;
    const CorrectorOutcome outcome = correct(problem_, metric, {}, size, options, y, lambda, work);
    factorizations_ += outcome.factorisations;
    if (outcome.status != CorrectorStatus::converged) {
      const auto state =
          find_contact_state(problem_, metric, reference, work, factorizations_, nullptr, true);
      if (!state) return false;
      y = state->y;
    }
  }
  contact_ = problem_.frozen_contact(y, true);
  if (structure_.curved()) contact_.linearised_at = y;
  marks_ = problem_.marks_at(y, true);
  return true;
}

bool BucklingPencil::set_prestress(double reference) {
  const SharedHolds soft = held_softly(problem_);
  problem_.set_holds(soft);
  if ((structure_.one_sided || structure_.curved()) && !freeze_contact(reference)) return false;
  if (soft) {
    Regime small = regime();
    small.small_displacements = true;
    holds_ = softly_held(problem_, soft, VectorXd::Zero(problem_.size()), 0.0, small).neutral;
    ++factorizations_;
    problem_.set_holds(holds_);
  }
  constant_ = linear_response(StructuralProblem::Stage::constant, 1.0, regime());
  proportional_ = linear_response(StructuralProblem::Stage::proportional, 1.0, regime());
  return true;
}

VectorXd BucklingPencil::stress(double lambda) const {
  VectorXd y = VectorXd::Zero(problem_.size());
  const int p = structure_.mesh.order;
  for (const ElementDofs& dofs : structure_.dofs)
    y.segment(dofs.s, 3 * p) =
        constant_.segment(dofs.s, 3 * p) + sense_ * lambda * proportional_.segment(dofs.s, 3 * p);
  return y;
}

int BucklingPencil::count(double lambda) {
  VectorXd residual;
  ++factorizations_;
  return problem_.linearise(stress(lambda), sense_ * lambda, residual, regime_at(lambda)).negative;
}

VectorXd BucklingPencil::geometric(const VectorXd& x) { return product(1.0, x) - product(0.0, x); }

}  // namespace snapthrough
