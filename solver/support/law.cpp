#include "solver/support/law.h"

namespace snapthrough {

Direction fixed_direction(const std::array<double, 2>& along, double sign) {
  const double size = std::hypot(along[0], along[1]);
  return {false, {sign * along[0] / size, sign * along[1] / size}, 1.0};
}

Direction direction_of(const Foundation& foundation) {
  const double sense = sense_of(foundation.reaction);
  if (foundation.direction) return fixed_direction(*foundation.direction, sense);
  return {true, {}, foundation.side == Side::left ? sense : -sense};
}

FoundationLaw law_of(const Foundation& foundation, const Scales& scales) {
  const bool one_sided = foundation.reaction != Reaction::bilateral;
  const double gap = one_sided ? scales.scaled_length(foundation.gap) : 0.0;
  return {direction_of(foundation),
          {scales.scaled_modulus(foundation.stiffness), gap, one_sided},
          scales.scaled_force(foundation.shear_stiffness),
          sense_of(foundation.reaction)};
}

SpringLaw law_of(const Spring& spring, const Scales& scales) {
  const bool one_sided = spring.reaction != Reaction::bilateral;
  const double gap = one_sided ? spring.gap : 0.0;
  const double sense = sense_of(spring.reaction);
  if (!spring.direction)
    return {{0.0, 0.0, sense}, {scales.scaled_rotational(spring.stiffness), gap, one_sided}, sense};
  const Direction direction = fixed_direction(*spring.direction, sense);
  return {{direction.fixed[0], direction.fixed[1], 0.0},
          {scales.scaled_stiffness(spring.stiffness), scales.scaled_length(gap), one_sided},
          sense};
}

bool has_one_sided_supports(const Model& model) {
  const auto one_sided = [](const auto& support) { return is_one_sided(support); };
  return std::any_of(model.springs.begin(), model.springs.end(), one_sided) ||
         std::any_of(model.foundations.begin(), model.foundations.end(), one_sided);
}

}  // namespace snapthrough
