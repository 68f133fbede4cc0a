#pragma once
/// @file
/// The test that decides whether a step along the path is accepted.

namespace snapthrough {

/// @brief Thresholds of the step test and bounds of step sizes. Lengths are in the path's norm, angles in
/// rad, ratios without unit. Sources: the design of docs/decisions/0014 and 0016, and docs/stress.md.
struct StepLimits {
  double min_step = 1e-13;          ///< arc length below which a step is given up
  double max_step = 1e12;           ///< arc length of the largest step: in effect the load's bound
  double target_angle = 0.30;       ///< wanted angle between the tangents at both ends
  double max_angle = 0.9;           ///< largest angle; target_angle where zones of contact begin, end or meet
  double target_correction = 0.08;  ///< wanted first correction over the step's length
  double max_correction = 0.5;      ///< a larger one says that the predictor missed the path
  /// Largest distance of the displacement increment from the span of the two end tangents, over the
  /// increment: smooth steps stay below 0.15, those onto another path or over a snap are at 0.5 and more.
  double max_tangent_mismatch = 0.4;
  double target_missed_contact = 0.5;  ///< wanted error of the contact forecast, elements
  double max_missed_contact = 2.0;     ///< largest error of the contact forecast, elements
  double min_growth = 0.3;             ///< smallest factor from one step size to the next
  double max_growth = 2.5;             ///< largest factor from one step size to the next
  double max_shortening = 0.5;         ///< largest factor from a rejected step to the next attempt
  /// Share of the last full step at which a step that still fails is taken for one that meets a kink.
  double kink_share = 1e-3;
};

/// What was measured on one attempted step.
struct StepMeasures {
  bool converged = false;             ///< the corrector found an equilibrium; else nothing below is set
  double angle = 0.0;                 ///< between the tangents at both ends, rad
  double correction = 0.0;            ///< first correction over the step's length
  double tangent_mismatch = 0.0;      ///< see StepLimits::max_tangent_mismatch
  double missed_contact = 0.0;        ///< elements on which contact is not as forecast
  bool contact_zones_change = false;  ///< the forecast has zones that begin, end or meet
  int corrections = 0;                ///< Newton iterations
};

/// Sizes that the test compares, in the path's norm.
struct StepSizes {
  double size = 0.0;            ///< size of the attempt
  double last_full_step = 0.0;  ///< remembered size of steps that were accepted at their first size
};

/// What becomes of an attempted step.
enum class StepVerdict {
  accepted,  ///< its end is on the path that it started on, as far as both ends tell
  too_long,  ///< to be tried again with a smaller size
  kink       ///< too long at a size so small that the path must turn sharply within it
};

struct StepDecision {
  StepVerdict verdict = StepVerdict::too_long;
  double factor = 1.0;  ///< size of the next step (accepted) or of the next attempt over this one's
};

/// @brief Whether a step whose end is `measures` may be accepted.
[[nodiscard]] bool is_acceptable(const StepMeasures& measures, const StepLimits& limits);

/// @brief The only place where a step is accepted or rejected by what was measured on it.
/// @param may_kink whether supports act on one side only, so that paths may turn sharply
[[nodiscard]] StepDecision judge_step(const StepMeasures& measures, const StepLimits& limits,
                                      const StepSizes& sizes, bool may_kink);

}  // namespace snapthrough
