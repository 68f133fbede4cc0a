#include "solver/newton/contact_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Search of the contact state; ratios. Source: docs/decisions/0011 (grip) and 0022.
struct ContactStateLimits {
  /// Smallest grip (share of the supports' stiffness) that is tried before release_grip() gives up.
  static constexpr double least_grip = 1e-20;
  static constexpr double fastest_release = 0.1;   ///< smallest factor between successive grips
  static constexpr double slowest_release = 0.97;  ///< largest factor before release_grip() gives up
  static constexpr double try_free = 1e-3;         ///< grip below which equilibrium without grip is tried
  static constexpr double shrunk = 0.1;         ///< decrease of the displacement norm that requires a restart
  static constexpr double least_scale = 1e-14;  ///< smallest displacement norm as scale
  static constexpr double softest = 1e-12;  ///< smallest softness: factor on stiffness of one-sided supports
  static constexpr double softer = 1e-3;    ///< softening per attempt
  static constexpr double slowest_hardening = 1.3;  ///< smallest stiffening factor per step
};

/// Arguments common to all attempts at one load.
struct Attempt {
  EquilibriumProblem& problem;
  const PathMetric& metric;
  double lambda;
  CorrectorOptions options;
  Workspace& work;
  int& factorisations;
  bool small_displacements;
};

/// Linear response from the unloaded state; false when the structure is singular.
bool first_guess(Attempt& attempt, bool bilateral, double softness, ContactState& state) {
  state.y = VectorXd::Zero(attempt.problem.size());
  Regime regime;
  if (bilateral) regime.contact = Regime::Contact::bilateral;
  regime.softness = softness;
  regime.small_displacements = attempt.small_displacements;
  state.tangent = attempt.problem.linearise(state.y, attempt.lambda, attempt.work.residual, regime);
  ++attempt.factorisations;
  state.y = -attempt.work.residual;
  attempt.problem.solve(state.y);
  return state.y.allFinite() && attempt.metric.norm(state.y, 0.0) < kSingularResponse;
}

/// Newton's method at fixed load from state.y.
bool settle(Attempt& attempt, const Regime& regime, ContactState& state) {
  const SideCondition load_control;
  CorrectorOptions options = attempt.options;
  options.regime = regime;
  options.regime.small_displacements = attempt.small_displacements;
  double lambda = attempt.lambda;
  // restarts with a smaller scale when the guess was far too large: the tolerance is relative to the scale
  for (double scale = std::max(attempt.metric.norm(state.y, 0.0), ContactStateLimits::least_scale);;) {
    const auto outcome =
        correct(attempt.problem, attempt.metric, load_control, scale, options, state.y, lambda, attempt.work);
    attempt.factorisations += outcome.factorisations;
    state.tangent = outcome.tangent;
    state.relative_residual = outcome.relative_residual;
    if (outcome.status != CorrectorStatus::converged) return false;
    const double size = std::max(attempt.metric.norm(state.y, 0.0), ContactStateLimits::least_scale);
    if (size > ContactStateLimits::shrunk * scale) return true;
    scale = size;
  }
}

/// Newton's method with a given grip; `state` changes only on success.
bool settle_with(Attempt& attempt, double grip, ContactState& state) {
  ContactState trial = state;
  Regime regime;
  regime.grip = grip;
  const bool settled = settle(attempt, regime, trial);
  if (settled) state = std::move(trial);
  return settled;
}

/// Solves with supports so soft that contact is lost or kept as a whole, then stiffens them step by step. On
/// stiff supports Newton's method moves the ends of contact by only a few decay lengths per iteration.
bool harden(Attempt& attempt, ContactState& state) {
  double softness = ContactStateLimits::softer;
  const auto settle_at = [&](double share, bool from_guess) {
    Regime regime;
    regime.softness = share;
    ContactState trial = state;
    const bool settled =
        (!from_guess || first_guess(attempt, true, share, trial)) && settle(attempt, regime, trial);
    if (settled) state = std::move(trial);
    return settled;
  };
  while (!settle_at(softness, true)) {
    softness *= ContactStateLimits::softer;
    if (softness < ContactStateLimits::softest) return false;
  }
  double harder = 1.0 / ContactStateLimits::softer;
  while (softness < 1.0 && harder > ContactStateLimits::slowest_hardening) {
    const double next = std::min(1.0, softness * harder);
    if (settle_at(next, false)) {
      softness = next;
      harder *= 2.0;
    } else {
      harder = std::sqrt(harder);
    }
  }
  return softness == 1.0;
}

/// Solves with the full grip from the bilateral response, then reduces the grip step by step.
bool release_grip(Attempt& attempt, ContactState& state) {
  double grip = 1.0;
  double release = ContactStateLimits::fastest_release;
  if (!settle_with(attempt, grip, state)) return false;
  while (grip > ContactStateLimits::least_grip && release < ContactStateLimits::slowest_release) {
    if (!settle_with(attempt, grip * release, state)) {
      release = std::sqrt(release);
      continue;
    }
    grip *= release;
    release = std::max(ContactStateLimits::fastest_release, release * release);
    if (grip < ContactStateLimits::try_free && settle_with(attempt, 0.0, state)) return true;
  }
  return false;
}

}  // namespace

std::optional<ContactState> find_contact_state(EquilibriumProblem& problem, const PathMetric& metric,
                                               double lambda, Workspace& work, int& factorisations,
                                               const VectorXd* guess, bool small_displacements) {
  CorrectorOptions options = downhill({}, 25);
  // only the path's direction depends on the state, whose error is about the square of this tolerance
  options.tangent_tolerance = 1e-5;
  options.largest_residual = options.tangent_tolerance;
  Attempt attempt{problem, metric, lambda, options, work, factorisations, small_displacements};
  ContactState state;
  ContactState bilateral;
  if (guess != nullptr) {
    state.y = *guess;
    if (settle(attempt, {}, state)) return state;
  }
  for (const bool bonded : {true, false}) {
    if (!first_guess(attempt, bonded, 1.0, state)) continue;
    if (bonded) bilateral = state;
    if (state.y.isZero(0.0) || settle(attempt, {}, state)) return state;
  }
  if (bilateral.y.size() == 0) return std::nullopt;
  if (harden(attempt, state)) return state;
  if (!release_grip(attempt, bilateral)) return std::nullopt;
  return bilateral;
}

}  // namespace snapthrough
