/// Continuation: the states that a path may begin with.

#include <cmath>
#include <optional>
#include <utility>

#include "solver/numeric/pseudo_random.h"
#include "solver/path/continuation.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Displacement gradients of a first state over those of small displacements, beyond which it is another
/// state. A rotation that can just close a gap is twice that of small displacements: from an angle a it moves
/// sin(a + t) - sin(a), which they take for t cos(a). A chain of them may need somewhat more.
constexpr double kFarStart = 3.0;
/// Most Newton corrections, each lowering the energy, of a first state that is nearly in equilibrium.
constexpr int kCorrections = 25;

}  // namespace

/// Whether the tangent whose factors are at hand, of a state on one-sided supports, lets some part move that
/// the supports would hold if they were glued to it: nothing loads it, or it would lean on them. All states
/// that differ by this motion are equilibria, and signs of determinants are rounding's.
bool Continuation::is_loose() {
  VectorXd motion = metric_.weights->cwiseProduct(pseudo_random(problem_.size(), 1U));
  VectorXd held = motion;
  problem_.solve(motion);
  const double size = metric_.norm(motion, 0.0);
  if (size < kSingularResponse) return false;
  Regime glued;
  glued.contact = Regime::Contact::bilateral;
  problem_.linearise(VectorXd::Zero(problem_.size()), 0.0, work_.residual, glued);
  ++statistics_.factorizations;
  problem_.solve(held);
  if (size < kSingularResponse * metric_.norm(held, 0.0)) return false;
  loose_motion_ = std::move(motion);
  return true;
}

/// The start of a path at rest that is found from the equilibrium of small displacements under `lambda`.
std::optional<PathPoint> Continuation::near_start(double lambda, double direction) {
  const auto near =
      find_contact_state(problem_, metric_, lambda, work_, statistics_.factorizations, nullptr, true);
  if (!near) return std::nullopt;
  PathPoint rest;
  rest.y = near->y;
  rest.lambda = lambda;
  return start_at_rest(std::move(rest), direction);
}

/// Whether a state at rest lies farther from the unloaded one than gaps and elastic strains explain: than the
/// state of small displacements under the same load does, by more than a factor.
bool Continuation::is_far(const PathPoint& rest) {
  const auto near =
      find_contact_state(problem_, metric_, rest.lambda, work_, statistics_.factorizations, nullptr, true);
  if (!near) return false;
  const FarStart start{metric_.norm(rest.y, 0.0), metric_.norm(near->y, 0.0)};
  if (start.moved <= kFarStart * start.explained) return false;
  far_start_ = start;
  return true;
}

/// From a state that the structure moved to under a very small load, corrected to the last digit.
std::optional<PathPoint> Continuation::start_at_rest(PathPoint rest, double direction) {
  const auto outcome = correct_downhill(metric_.norm(rest.y, 0.0), kCorrections, rest);
  if (outcome.status != CorrectorStatus::converged || is_far(rest)) return std::nullopt;
  return begin_at(rest, direction);
}

/// The first point of a path at an equilibrium; empty where the tangent is singular.
std::optional<PathPoint> Continuation::begin_at(const PathPoint& equilibrium, double direction) {
  VectorXd response;
  TangentReport report;
  if (!unit_response(equilibrium.y, equilibrium.lambda, Regime::Contact::unilateral, response, report))
    return std::nullopt;
  return first_point(equilibrium.y, equilibrium.lambda, response, direction, report);
}

std::optional<PathPoint> Continuation::start_at(const VectorXd& y, double direction,
                                                const SharedHolds& holds) {
  problem_.set_holds(holds);
  metric_.load_weight = 0.0;
  VectorXd response;
  TangentReport report;
  if (!unit_response(y, 0.0, Regime::Contact::unilateral, response, report)) return std::nullopt;
  PathPoint start = first_point(y, 0.0, response, direction, report);
  if (problem_.one_sided()) turn_where_supports_touch(start, direction, response);
  start.holds = holds;
  return start;
}

std::optional<PathPoint> Continuation::start_from(const VectorXd& y, double lambda, double direction) {
  metric_.load_weight = 0.0;
  PathPoint at;
  at.y = y;
  at.lambda = lambda;
  const auto outcome = correct_downhill(metric_.norm(y, 0.0), kCorrections, at);
  if (outcome.status != CorrectorStatus::converged) return std::nullopt;
  return begin_at(at, direction);
}

}  // namespace snapthrough
