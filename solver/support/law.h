#pragma once
/// @file
/// How a support reacts, and along which direction: made once from a spring or a foundation of the model.

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/model/model.h"
#include "solver/model/scales.h"

namespace snapthrough {

/// @brief Reaction of a support to a displacement w along its direction, which points into its medium:
/// k w, or of a one-sided support k max(w - gap, 0). Against the direction; of foundations by length.
struct Law {
  double stiffness = 0.0;
  double gap = 0.0;  ///< zero where it is bilateral
  bool one_sided = false;

  /// The part of w that is resisted.
  [[nodiscard]] double penetration(double w) const { return one_sided ? std::max(w - gap, 0.0) : w; }
  [[nodiscard]] double reaction(double w) const { return stiffness * penetration(w); }
  /// d reaction / dw; at a kink that of the side where nothing is resisted.
  [[nodiscard]] double tangent(double w) const { return !one_sided || w > gap ? stiffness : 0.0; }
  /// Its derivative is the reaction.
  [[nodiscard]] double energy(double w) const { return 0.5 * stiffness * penetration(w) * penetration(w); }
  /// Whether it reacts at all.
  [[nodiscard]] bool acts(double w) const { return stiffness > 0.0 && (!one_sided || w > gap); }
};

/// A unit direction in the plane: fixed to the ground, or the left normal of a member's initial axis times a
/// sign, which turns along the member.
struct Direction {
  bool turns = false;
  std::array<double, 2> fixed{};
  double sign = 1.0;

  /// @param angle of the axis' tangent
  [[nodiscard]] std::array<double, 2> at(double angle) const {
    return turns ? std::array{-sign * std::sin(angle), sign * std::cos(angle)} : fixed;
  }
  /// d/ds along the axis.
  [[nodiscard]] std::array<double, 2> rate(double angle, double curvature) const {
    const double turn = turns ? -sign * curvature : 0.0;
    return {turn * std::cos(angle), turn * std::sin(angle)};
  }
};

/// @brief -1 for a support that only pulls, which reacts to displacements against the direction that the user
/// gave: results, in the user's sense, are this times what its law says.
[[nodiscard]] inline double sense_of(Reaction reaction) {
  return reaction == Reaction::tension_only ? -1.0 : 1.0;
}
/// A displacement or reaction of a law in the user's sense; nothing has no sign.
[[nodiscard]] inline double in_users_sense(double sense, double value) { return sense * value + 0.0; }

/// @param along of any length, not zero
[[nodiscard]] Direction fixed_direction(const std::array<double, 2>& along, double sign);
/// Into the medium that resists.
[[nodiscard]] Direction direction_of(const Foundation& foundation);
template <class Support>
[[nodiscard]] bool is_one_sided(const Support& support) {
  return support.reaction != Reaction::bilateral && support.stiffness > 0.0;
}

[[nodiscard]] bool has_one_sided_supports(const Model& model);

/// A foundation as it reacts, scaled.
struct FoundationLaw {
  Direction direction;
  Law law;             ///< by length
  double shear = 0.0;  ///< stiffness of its shear layer
  double sense = 1.0;  ///< sense_of()
};
/// A spring as it reacts, scaled.
struct SpringLaw {
  std::array<double, 3> row{};  ///< its displacement: weights of x, y and the rotation
  Law law;
  double sense = 1.0;  ///< sense_of()
};

[[nodiscard]] FoundationLaw law_of(const Foundation& foundation, const Scales& scales);
[[nodiscard]] SpringLaw law_of(const Spring& spring, const Scales& scales);

}  // namespace snapthrough
