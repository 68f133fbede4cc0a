#include "solver/support/law.h"

#include <algorithm>

#include "solver/support/catenary.h"
#include "solver/support/law_numbers.h"

namespace snapthrough {

Direction fixed_direction(const std::array<double, 2>& along, double sign) {
  const double size = std::hypot(along[0], along[1]);
  return {false, {sign * along[0] / size, sign * along[1] / size}, 1.0};
}

Direction direction_of(const Foundation& foundation) {
  const double sense = sense_of(foundation.reaction);
  if (foundation.direction) return fixed_direction(*foundation.direction, sense);
  if (foundation.component == FoundationComponent::rotation) return {false, {1.0, 0.0}, 1.0};
  if (foundation.component == FoundationComponent::tangent) return {true, {}, 1.0, true};
  return {true, {}, foundation.side == Side::left ? sense : -sense};
}

namespace {

AlongMember over_largest(AlongMember value) {
  const double largest = value.largest();
  if (!value.varies()) return 1.0;
  return value *= largest > 0.0 ? 1.0 / largest : 0.0;
}

/// Variation of a law along its member; null when the law is constant.
std::shared_ptr<const LawVariation> variation_of(const ReactionLaw& law) {
  const LawNumbers numbers = numbers_of(law);
  if (!numbers.stiffness.varies() && !numbers.capacity.varies()) return nullptr;
  return std::make_shared<LawVariation>(
      LawVariation{over_largest(numbers.stiffness), over_largest(numbers.capacity)});
}

/// Sets capacity, shape and curve of a law.
/// @param unit scaled capacity of the capacity 1
void set_curve(const ReactionLaw& given, const ReactionCurve* curve, double unit, Law& law) {
  if (curve == nullptr) return;
  const LawNumbers numbers = numbers_of(given);
  const double stiffness = numbers.stiffness.largest();
  const double capacity = numbers.capacity.largest();
  law.capacity = unit * capacity;
  law.shape = stiffness * given.reference / capacity;
  law.curve = curve;
}

template <class Support>
double stiffness_of(const Support& support) {
  return support.law ? numbers_of(*support.law).stiffness.largest() : support.stiffness;
}

/// Values over their largest size.
AlongMember shape_of(AlongMember value) {
  const double largest = largest_size(value);
  value *= largest > 0.0 ? 1.0 / largest : 0.0;
  return value;
}

}  // namespace

double initial_stiffness(const Foundation& foundation) { return stiffness_of(foundation); }
double initial_stiffness(const Spring& spring) { return stiffness_of(spring); }

Law FoundationLaw::at(double fraction) const {
  Law out = law;
  if (variation) {
    const double share = variation->stiffness.at(fraction);
    out.stiffness *= share;
    if (out.curve != nullptr) {
      const double capacity = variation->capacity.at(fraction);
      out.capacity *= capacity;
      out.shape *= share / capacity;
      if (!(out.stiffness > 0.0 && out.capacity > 0.0)) out = {0.0, law.gap, law.one_sided};
    }
  }
  out.bound_stiffness(stiffest);
  out.gap = value_at(law.gap, gap_along, fraction);
  return out;
}

GroundMotion FoundationLaw::ground_under(double from, double to) const {
  GroundMotion out;
  if (ground < 0) return out;
  out.unknown = ground;
  for (std::size_t c = 0; c < 2; ++c) {
    out.start[c] = (*ground_shape)[c].at(from);
    out.change[c] = (*ground_shape)[c].at(to) - out.start[c];
  }
  return out;
}

SurfacePoint FoundationLaw::below_surface(const PlaceOnAxis& at, std::array<double, 2> u) const {
  if (follows_surface()) return surface->at(at.x, u);
  const SurfacePoint initial = surface->at(at.x);
  const auto d = initial.into;
  return {initial.depth + u[0] * d[0] + u[1] * d[1], d, 0.0, 0.0, initial.size};
}

double largest_size(const AlongMember& value) { return std::max(value.largest(), -value.least()); }

FoundationLaw law_of(const Foundation& foundation, const Scales& scales, std::array<double, 2> origin) {
  const bool one_sided = foundation.reaction != Reaction::bilateral;
  FoundationLaw out;
  out.direction = direction_of(foundation);
  out.rotational = foundation.component == FoundationComponent::rotation;
  const double stiffness = initial_stiffness(foundation);
  // a moment per length is a force
  out.law = {out.rotational ? scales.scaled_force(stiffness) : scales.scaled_modulus(stiffness),
             one_sided ? scales.scaled_length(foundation.gap) : 0.0, one_sided};
  out.shear = scales.scaled_force(foundation.shear_stiffness);
  out.endless = foundation.ground_end == GroundEnd::endless;
  out.sense = sense_of(foundation.reaction);
  for (const auto& [fraction, gap] : foundation.gap_along)
    out.gap_along.emplace_back(fraction, scales.scaled_length(gap));
  if (foundation.outline) {
    out.direction = {true, {}, 1.0};
    out.surface = make_surface(*foundation.outline, origin, scales.length);
  }
  if (foundation.displacement)
    out.ground_shape = std::make_shared<const std::array<AlongMember, 2>>(
        std::array{shape_of(foundation.displacement->x), shape_of(foundation.displacement->y)});
  if (!foundation.law) return out;
  out.curve = curve_of(*foundation.law);
  out.variation = variation_of(*foundation.law);
  set_curve(*foundation.law, out.curve.get(),
            out.rotational ? scales.scaled_force(1.0) : scales.scaled_line_load(1.0), out.law);
  return out;
}

SpringLaw law_of(const Spring& spring, const Scales& scales) {
  const bool one_sided = spring.reaction != Reaction::bilateral;
  const double gap = one_sided ? spring.gap : 0.0;
  const double stiffness = initial_stiffness(spring);
  SpringLaw out;
  out.sense = sense_of(spring.reaction);
  double unit = scales.scaled_moment(1.0);
  if (spring.direction) {
    const Direction direction = fixed_direction(*spring.direction, out.sense);
    out.row = {direction.fixed[0], direction.fixed[1], 0.0};
    out.law = {scales.scaled_stiffness(stiffness), scales.scaled_length(gap), one_sided};
    unit = scales.scaled_force(1.0);
    if (spring.rod)
      out.length = scales.scaled_length(std::hypot((*spring.direction)[0], (*spring.direction)[1]));
  } else {
    out.row = {0.0, 0.0, out.sense};
    out.law = {scales.scaled_rotational(stiffness), gap, one_sided};
  }
  if (const auto& cable = spring.cable) {
    out.cable = std::make_shared<const Catenary>(
        scales.scaled_force(cable->axial_stiffness), scales.scaled_length(cable->length),
        scales.scaled_line_load(1.0) * Eigen::Vector2d(cable->weight[0], cable->weight[1]));
    const Eigen::Vector2d chord = out.length * Eigen::Vector2d(out.row[0], out.row[1]);
    const Eigen::Vector2d pull = out.cable->pull({chord, 0.0}).force;
    out.drawn_pull = {pull[0], pull[1]};
  }
  if (!spring.law) return out;
  out.curve = curve_of(*spring.law);
  set_curve(*spring.law, out.curve.get(), unit, out.law);
  return out;
}

bool has_one_sided_supports(const ResolvedModel& model) {
  const auto one_sided = [](const auto& support) { return is_one_sided(support); };
  return std::any_of(model.springs.begin(), model.springs.end(), one_sided) ||
         std::any_of(model.foundations.begin(), model.foundations.end(), one_sided);
}

}  // namespace snapthrough
