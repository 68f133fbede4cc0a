#include "solver/support/law_numbers.h"

#include <algorithm>

#include "solver/support/reaction_curve.h"

namespace snapthrough {
namespace {

LawNumbers numbers_of_table(const ReactionLaw& law) {
  double most = 0.0;
  for (const auto& point : law.points) most = std::max(most, point[1]);
  LawNumbers out{law.factor, law.factor};
  out.stiffness *= initial_slope(law);
  out.capacity *= most;
  return out;
}

}  // namespace

LawNumbers numbers_of(const ReactionLaw& law) {
  switch (law.type) {
    case ReactionLaw::Type::linear:
    case ReactionLaw::Type::tanh:
    case ReactionLaw::Type::hyperbolic:
    case ReactionLaw::Type::power:
      return {law.stiffness, law.capacity};
    case ReactionLaw::Type::table:
      return numbers_of_table(law);
  }
  return {};
}

}  // namespace snapthrough
