#pragma once
/// @file
/// Reaction laws and directions of springs and foundations.

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/model/model.h"
#include "solver/model/scales.h"

namespace snapthrough {

/// @brief Reaction to a displacement w into the medium: k w, or k max(w - gap, 0) for a one-sided support.
/// Acts against the direction; for foundations per length.
struct Law {
  double stiffness = 0.0;
  double gap = 0.0;  ///< zero for bilateral supports
  bool one_sided = false;

  /// The part of w that is resisted.
  [[nodiscard]] double penetration(double w) const { return one_sided ? std::max(w - gap, 0.0) : w; }
  [[nodiscard]] double reaction(double w) const { return stiffness * penetration(w); }
  /// d reaction / dw; zero at the kink.
  [[nodiscard]] double tangent(double w) const { return !one_sided || w > gap ? stiffness : 0.0; }
  /// Potential of the reaction.
  [[nodiscard]] double energy(double w) const { return 0.5 * stiffness * penetration(w) * penetration(w); }
  /// Whether the reaction is active at w.
  [[nodiscard]] bool acts(double w) const { return stiffness > 0.0 && (!one_sided || w > gap); }
};

/// Unit direction in the plane: fixed in space, or sign times the left normal of a member's initial axis,
/// which varies along the member.
struct Direction {
  bool turns = false;
  std::array<double, 2> fixed{};
  double sign = 1.0;

  /// @param angle angle of the axis tangent, rad
  [[nodiscard]] std::array<double, 2> at(double angle) const {
    return turns ? std::array{-sign * std::sin(angle), sign * std::cos(angle)} : fixed;
  }
  /// Derivative with respect to arc length.
  [[nodiscard]] std::array<double, 2> rate(double angle, double curvature) const {
    const double turn = turns ? -sign * curvature : 0.0;
    return {turn * std::cos(angle), turn * std::sin(angle)};
  }
};

/// @brief -1 for tension-only supports, whose law uses the direction opposite to the user's, else 1: factor
/// from values of the law to results.
[[nodiscard]] inline double sense_of(Reaction reaction) {
  return reaction == Reaction::tension_only ? -1.0 : 1.0;
}
/// Value of a law in the user's sense; never negative zero.
[[nodiscard]] inline double in_users_sense(double sense, double value) { return sense * value + 0.0; }

/// @param along any length except zero
[[nodiscard]] Direction fixed_direction(const std::array<double, 2>& along, double sign);
/// Direction into the resisting medium.
[[nodiscard]] Direction direction_of(const Foundation& foundation);
template <class Support>
[[nodiscard]] bool is_one_sided(const Support& support) {
  return support.reaction != Reaction::bilateral && support.stiffness > 0.0;
}

[[nodiscard]] bool has_one_sided_supports(const Model& model);

/// Reaction law of a foundation, scaled.
struct FoundationLaw {
  Direction direction;
  Law law;             ///< reaction per length
  double shear = 0.0;  ///< stiffness G of the shear layer
  double sense = 1.0;  ///< factor on results, see sense_of()
};
/// Reaction law of a spring, scaled.
struct SpringLaw {
  std::array<double, 3> row{};  ///< weights of x, y and rotation in the displacement
  Law law;
  double sense = 1.0;  ///< factor on results, see sense_of()
};

[[nodiscard]] FoundationLaw law_of(const Foundation& foundation, const Scales& scales);
[[nodiscard]] SpringLaw law_of(const Spring& spring, const Scales& scales);

}  // namespace snapthrough
