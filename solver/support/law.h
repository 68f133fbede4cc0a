#pragma once
/// @file
/// Reaction laws and directions of springs and foundations.

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/model/model.h"
#include "solver/model/scales.h"

namespace snapthrough {

/// @brief Reaction law of a support: the force against its direction (per length for foundations) as a
/// function of the penetration. Equilibrium, tangent and reports ask force_at(), stiffness_at() and
/// penetration_at(); tests compare energy_at() with them. A law of another shape changes these four functions
/// and scale().
///
/// A bilateral support reacts at every displacement w into the medium, a one-sided one where w exceeds the
/// gap. The penetration is w beyond the gap; that of a bilateral support may be negative. Today's law is
/// linear.
struct Law {
  double stiffness = 0.0;  ///< force by penetration
  double gap = 0.0;        ///< zero for bilateral supports
  bool one_sided = false;

  [[nodiscard]] double force_at(double penetration) const { return stiffness * penetration; }
  /// d force / d penetration.
  [[nodiscard]] double stiffness_at(double /*penetration*/) const { return stiffness; }
  /// Inverse of force_at(). @pre the force is not zero
  [[nodiscard]] double penetration_at(double force) const { return force / stiffness; }
  /// Potential of the force; its derivative is force_at().
  [[nodiscard]] double energy_at(double penetration) const {
    return 0.5 * stiffness * penetration * penetration;
  }
  /// Multiplies the force by a factor: a quadrature weight, a length, or a share of the support that acts.
  void scale(double factor) { stiffness *= factor; }

  /// The part of w that is resisted.
  [[nodiscard]] double penetration(double w) const { return one_sided ? std::max(w - gap, 0.0) : w; }
  [[nodiscard]] double reaction(double w) const { return force_at(penetration(w)); }
  /// d reaction / dw; zero at the kink.
  [[nodiscard]] double tangent(double w) const {
    return !one_sided || w > gap ? stiffness_at(penetration(w)) : 0.0;
  }
  [[nodiscard]] double energy(double w) const { return energy_at(penetration(w)); }
  /// Whether the reaction is active at w.
  [[nodiscard]] bool acts(double w) const { return stiffness > 0.0 && (!one_sided || w > gap); }
};

/// Unit direction in the plane: fixed in space, or sign times the left normal of a member's initial axis,
/// which varies along the member.
struct Direction {
  bool turns = false;
  std::array<double, 2> fixed{};
  double sign = 1.0;

  bool operator==(const Direction&) const = default;
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
