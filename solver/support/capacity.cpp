#include "solver/support/capacity.h"

#include <algorithm>

namespace snapthrough {

bool has_supports_with_capacity(const ResolvedModel& model) {
  const auto capped = [](const auto& support) { return has_capacity(support); };
  return std::any_of(model.springs.begin(), model.springs.end(), capped) ||
         std::any_of(model.foundations.begin(), model.foundations.end(), capped);
}

bool has_falling_laws(const ResolvedModel& model) {
  const auto falls = [](const auto& support) {
    if (!support.law || support.law->type != ReactionLaw::Type::table) return false;
    return std::ranges::adjacent_find(support.law->points, [](const auto& before, const auto& after) {
             return after[1] < before[1];
           }) != support.law->points.end();
  };
  return std::ranges::any_of(model.springs, falls) || std::ranges::any_of(model.foundations, falls);
}

}  // namespace snapthrough
