#include "solver/support/capacity.h"

#include <algorithm>
#include <cmath>

#include "solver/support/reaction_curve.h"

namespace snapthrough {

bool has_supports_with_capacity(const ResolvedModel& model) {
  const auto capped = [](const auto& support) { return has_capacity(support); };
  return std::any_of(model.springs.begin(), model.springs.end(), capped) ||
         std::any_of(model.foundations.begin(), model.foundations.end(), capped);
}

bool has_falling_laws(const ResolvedModel& model) {
  const auto falls = [](const auto& support) {
    const auto curve = support.law ? curve_of(*support.law) : nullptr;
    return curve && std::isfinite(curve->peak());
  };
  return std::ranges::any_of(model.springs, falls) || std::ranges::any_of(model.foundations, falls);
}

bool has_joint_laws(const ResolvedModel& model) {
  return std::ranges::any_of(model.members, [](const ResolvedMember& member) {
    return member.release_start_law || member.release_end_law;
  });
}

}  // namespace snapthrough
