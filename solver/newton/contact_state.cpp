#include "solver/newton/contact_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Smallest grip (share of the supports' stiffness) that is tried before release_grip() gives up.
constexpr double kLeastGrip = 1e-20;
/// Smallest factor between successive grips, and the largest one before release_grip() gives up.
constexpr double kFastestRelease = 0.1;
constexpr double kSlowestRelease = 0.97;
/// Grip below which equilibrium without grip is tried.
constexpr double kTryFree = 1e-3;
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
  constexpr double kSmaller = 0.1;       // decrease of the displacement norm that requires a restart
  constexpr double kLeastScale = 1e-14;  // smallest displacement norm as scale
  // restarts with a smaller scale when the guess was far too large: the tolerance is relative to the scale
  for (double scale = std::max(attempt.metric.norm(state.y, 0.0), kLeastScale);;) {
    const auto outcome =
        correct(attempt.problem, attempt.metric, load_control, scale, options, state.y, lambda, attempt.work);
    attempt.factorisations += outcome.factorisations;
    state.tangent = outcome.tangent;
    state.relative_residual = outcome.relative_residual;
    if (outcome.status != CorrectorStatus::converged) return false;
    const double size = std::max(attempt.metric.norm(state.y, 0.0), kLeastScale);
    if (size > kSmaller * scale) return true;
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
  constexpr double kSoftest = 1e-12;  // factor on the stiffness of one-sided supports
  constexpr double kSofter = 1e-3;    // softening per attempt
  constexpr double kSlowest = 1.3;    // smallest stiffening factor per step
  double softness = kSofter;
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
    softness *= kSofter;
    if (softness < kSoftest) return false;
  }
  double harder = 1.0 / kSofter;
  while (softness < 1.0 && harder > kSlowest) {
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
  double release = kFastestRelease;
  if (!settle_with(attempt, grip, state)) return false;
  while (grip > kLeastGrip && release < kSlowestRelease) {
    if (!settle_with(attempt, grip * release, state)) {
      release = std::sqrt(release);
      continue;
    }
    grip *= release;
    release = std::max(kFastestRelease, release * release);
    if (grip < kTryFree && settle_with(attempt, 0.0, state)) return true;
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
  ContactState glued;
  if (guess != nullptr) {
    state.y = *guess;
    if (settle(attempt, {}, state)) return state;
  }
  for (const bool bonded : {true, false}) {
    if (!first_guess(attempt, bonded, 1.0, state)) continue;
    if (bonded) glued = state;
    if (state.y.isZero(0.0) || settle(attempt, {}, state)) return state;
  }
  if (glued.y.size() == 0) return std::nullopt;
  if (harden(attempt, state)) return state;
  if (!release_grip(attempt, glued)) return std::nullopt;
  return glued;
}

}  // namespace snapthrough
