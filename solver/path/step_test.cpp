#include "solver/path/step_test.h"

#include <algorithm>
#include <cmath>

namespace snapthrough {
namespace {

/// Measures below this count as it, so that a straight path lets steps grow by the largest factor.
constexpr double kNothing = 1e-12;

/// Factor to the next step size that the measures allow.
double growth(const StepMeasures& measures, const StepLimits& limits) {
  if (!measures.converged) return limits.min_growth;
  const double by_path = std::min(limits.target_angle / std::max(measures.angle, kNothing),
                                  limits.target_correction / std::max(measures.correction, kNothing));
  // the forecast's error grows with the cube of the step
  const double by_contact =
      std::cbrt(limits.target_missed_contact / std::max(measures.missed_contact, kNothing));
  const double bounded = std::clamp(by_path, limits.min_growth, limits.max_growth);
  return std::max(limits.min_growth, std::min(bounded, by_contact));
}

}  // namespace

bool is_acceptable(const StepMeasures& measures, const StepLimits& limits) {
  const double max_angle = measures.contact_zones_change ? limits.target_angle : limits.max_angle;
  return measures.converged && measures.angle <= max_angle && measures.correction <= limits.max_correction &&
         measures.tangent_mismatch <= limits.max_tangent_mismatch &&
         measures.missed_contact <= limits.max_missed_contact;
}

StepDecision judge_step(const StepMeasures& measures, const StepLimits& limits, const StepSizes& sizes,
                        bool may_kink) {
  const double factor = growth(measures, limits);
  if (is_acceptable(measures, limits)) return {StepVerdict::accepted, factor};
  const double shorter = std::min(factor, limits.max_shortening);
  // a smooth turn that a shorter step will follow is no kink, however small it is
  const bool turns_smoothly = measures.converged && measures.angle <= limits.max_angle;
  const bool is_kink =
      may_kink && !turns_smoothly && sizes.size * shorter < limits.kink_share * sizes.last_full_step;
  return {is_kink ? StepVerdict::kink : StepVerdict::too_long, shorter};
}

}  // namespace snapthrough
