#include "tests/stress/soil_model.h"

#include <cstdint>

#include "tests/stress/laws_model.h"
#include "tests/stress/random_numbers.h"

namespace snapthrough::testing {
namespace {

/// Table that rises to about its peak like `law` and falls beyond it, in one to three parts, to a residual
/// reaction.
/// @pre law is not linear
ReactionLaw falling(const ReactionLaw& law, Random& random) {
  ReactionLaw out;
  out.type = ReactionLaw::Type::table;
  out.interpolation =
      random.chance(0.5) ? ReactionLaw::Interpolation::linear : ReactionLaw::Interpolation::monotone_cubic;
  double peak = 1.0;
  double yield = 0.0;
  if (law.type == ReactionLaw::Type::table) {
    out.factor = law.factor;
    for (const auto& [w, p] : law.points) {
      out.points.push_back({w, p});
      yield = w;
      peak = p;
    }
  } else {
    out.factor = law.capacity;
    yield = law.type == ReactionLaw::Type::power ? law.reference
                                                 : law.capacity.largest() / law.stiffness.largest();
    out.points = {{0.5 * yield, random.between(0.5, 0.9)}, {yield, peak}};
  }
  for (int parts = 1 + random.below(3); parts > 0; --parts) {
    const auto [w, p] = out.points.back();
    out.points.push_back(
        {w + yield * random.decades(-1.0, 1.0), random.chance(0.1) ? 0.0 : p * random.between(0.3, 1.0)});
  }
  return out;
}

}  // namespace

RandomRequest soil_request(std::uint64_t seed) {
  RandomRequest out = laws_request(seed);
  Random random(seed ^ 0x50111ULL);
  const auto let_fall = [&random](auto& supports) {
    for (auto& support : supports)
      if (support.law && support.law->type != ReactionLaw::Type::linear && random.chance(0.8))
        support.law = falling(*support.law, random);
  };
  let_fall(out.model.foundations);
  let_fall(out.model.springs);
  return out;
}

}  // namespace snapthrough::testing
