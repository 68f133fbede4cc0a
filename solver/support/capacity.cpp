#include "solver/support/capacity.h"

#include <algorithm>

namespace snapthrough {

double capacity_at(const ReactionLaw& law, double fraction) {
  if (law.type != ReactionLaw::Type::table) return law.capacity.at(fraction);
  return law.points.empty() ? 0.0 : law.factor.at(fraction) * law.points.back()[1];
}

bool has_supports_with_capacity(const ResolvedModel& model) {
  const auto capped = [](const auto& support) { return has_capacity(support); };
  return std::any_of(model.springs.begin(), model.springs.end(), capped) ||
         std::any_of(model.foundations.begin(), model.foundations.end(), capped);
}

}  // namespace snapthrough
