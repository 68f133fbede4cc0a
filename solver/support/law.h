#pragma once
/// @file
/// Reaction laws and directions of springs and foundations.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "solver/model/scales.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/ground_motion.h"
#include "solver/support/reaction_curve.h"
#include "solver/support/surface.h"

namespace snapthrough {

class Catenary;

/// @brief Reaction law of a support: the force against its direction (per length for foundations) as a
/// function of the penetration: linear, or capacity * f(stiffness * penetration / capacity) with a curve f.
///
/// A bilateral support reacts at every displacement w into the medium, a one-sided one where w exceeds the
/// gap. The penetration is w beyond the gap; that of a bilateral support may be negative.
struct Law {
  double stiffness = 0.0;  ///< force by penetration, at penetration zero
  double gap = 0.0;        ///< zero for bilateral supports
  bool one_sided = false;
  double capacity = 0.0;                 ///< unused without a curve
  double shape = 0.0;                    ///< second argument of the curve
  const ReactionCurve* curve = nullptr;  ///< null: linear; owned by the FoundationLaw or SpringLaw

  /// Force with its first and second derivative with respect to the penetration.
  struct Response {
    double force = 0.0;
    double stiffness = 0.0;
    double rate = 0.0;
  };
  [[nodiscard]] Response response_at(double penetration) const {
    if (curve == nullptr) return {stiffness * penetration, stiffness, 0.0};
    if (!(capacity > 0.0)) return {};  // on an interval without length
    const auto f = curve->at(stiffness * penetration / capacity, shape);
    return {capacity * f.force, stiffness * f.slope, stiffness * stiffness / capacity * f.curvature};
  }
  [[nodiscard]] double force_at(double penetration) const { return response_at(penetration).force; }
  /// d force / d penetration.
  [[nodiscard]] double stiffness_at(double penetration) const { return response_at(penetration).stiffness; }
  /// Potential of the force; its derivative is force_at().
  [[nodiscard]] double energy_at(double penetration) const {
    if (curve == nullptr) return 0.5 * stiffness * penetration * penetration;
    return capacity * capacity / stiffness * curve->energy(stiffness * penetration / capacity, shape);
  }
  /// Penetration from which the force falls for the first time; infinite where it never does.
  [[nodiscard]] double peak() const {
    if (curve == nullptr || !(stiffness > 0.0)) return std::numeric_limits<double>::infinity();
    return capacity / stiffness * curve->peak();
  }
  /// Multiplies the force by a factor: a quadrature weight, a length, or a share of the support that acts.
  void scale(double factor) {
    stiffness *= factor;
    capacity *= factor;
  }
  /// Lowers the stiffness at penetration zero, not the capacity.
  void bound_stiffness(double most) {
    if (!(stiffness > most)) return;
    shape *= most / stiffness;
    stiffness = most;
  }

  /// The part of w that is resisted.
  [[nodiscard]] double penetration(double w) const { return one_sided ? std::max(w - gap, 0.0) : w; }
  [[nodiscard]] double reaction(double w) const { return force_at(penetration(w)); }
  /// Reaction at a distance beyond the gap.
  [[nodiscard]] double reaction_beyond(double distance) const {
    return force_at(one_sided ? std::max(distance, 0.0) : distance);
  }
  /// d reaction / dw; zero at the kink.
  [[nodiscard]] double tangent(double w) const {
    return !one_sided || w > gap ? stiffness_at(penetration(w)) : 0.0;
  }
  [[nodiscard]] double energy(double w) const { return energy_at(penetration(w)); }
  /// Whether the reaction is active at w.
  [[nodiscard]] bool acts(double w) const { return stiffness > 0.0 && (!one_sided || w > gap); }
};

/// Unit direction in the plane: fixed in space, or sign times the left normal or the tangent of a member's
/// initial axis, which vary along the member.
struct Direction {
  bool turns = false;
  std::array<double, 2> fixed{};
  double sign = 1.0;
  bool tangential = false;

  bool operator==(const Direction&) const = default;
  /// @param angle angle of the axis tangent, rad
  [[nodiscard]] std::array<double, 2> at(double angle) const {
    if (!turns) return fixed;
    const std::array<double, 2> tangent{sign * std::cos(angle), sign * std::sin(angle)};
    return tangential ? tangent : std::array{-tangent[1], tangent[0]};
  }
  /// Derivative with respect to arc length. @pre not tangential
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

/// @brief Largest stiffness of a foundation or spring at penetration zero: the modulus K, or the slope of its
/// law.
[[nodiscard]] double initial_stiffness(const Foundation& foundation);
[[nodiscard]] double initial_stiffness(const Spring& spring);

/// @param along any length except zero
[[nodiscard]] Direction fixed_direction(const std::array<double, 2>& along, double sign);
/// Direction into the resisting medium.
[[nodiscard]] Direction direction_of(const Foundation& foundation);
template <class Support>
[[nodiscard]] bool is_one_sided(const Support& support) {
  return support.reaction != Reaction::bilateral && initial_stiffness(support) > 0.0;
}

/// Whether a pretension presses a one-sided spring on the undeformed structure.
[[nodiscard]] inline bool is_tight(const ResolvedSpring& spring) {
  return is_one_sided(spring) && -sense_of(spring.reaction) * spring.without_force[0] > spring.gap;
}
[[nodiscard]] inline bool is_tight(const ResolvedFoundation&) { return false; }

[[nodiscard]] bool has_one_sided_supports(const ResolvedModel& model);

/// Numbers of a foundation's law along its member, over their largest values.
struct LawVariation {
  AlongMember stiffness;
  AlongMember capacity;
};

/// Point of a member's initial axis, scaled.
struct PlaceOnAxis {
  std::array<double, 2> x{};
  double angle = 0.0;     ///< angle of the axis tangent, rad
  double fraction = 0.0;  ///< fraction of the member's length
};

/// Reaction law of a foundation, scaled.
struct FoundationLaw {
  Direction direction;  ///< not used with a surface
  /// Whether the foundation resists the rotation of the member's sections. The rotation then stands for the
  /// displacement along x, and `direction` is that of x.
  bool rotational = false;
  Law law;               ///< reaction per length, with the largest stiffness and capacity along the member
  double shear = 0.0;    ///< stiffness G of the shear layer
  bool endless = false;  ///< whether the ground with a one-sided shear layer continues beyond the range
  double sense = 1.0;    ///< factor on results, see sense_of()
  /// Whether the foundation is one-sided and has a shear layer (element/shear_layer.h).
  [[nodiscard]] bool has_layer() const { return law.one_sided && shear > 0.0; }
  std::shared_ptr<const ReactionCurve> curve;                 ///< curve of `law`; null: linear
  std::shared_ptr<const LawVariation> variation{};            ///< null: constant along the member
  double stiffest = std::numeric_limits<double>::infinity();  ///< bound of the stiffness

  Along<double> gap_along{};                 ///< empty: the gap of `law`
  std::shared_ptr<const Surface> surface{};  ///< surface of the medium; null: see `direction`
  /// Whether the surface acts by its tangents at the points nearest to the initial axis: for small
  /// displacements, and on meshes that lump foundations.
  bool fixed_tangents = false;
  /// Displacement (x, y) of the ground along the member, over its largest; not used where the ground is at
  /// rest.
  std::shared_ptr<const std::array<AlongMember, 2>> ground_shape{};
  int ground = -1;  ///< unknown of the ground's largest displacement along x; -1: at rest

  /// Displacement of the ground under a part of the member, given by fractions of its length, on which
  /// `ground_shape` is linear.
  [[nodiscard]] GroundMotion ground_under(double from, double to) const;
  /// Law at a fraction of the member's length, with the gap there.
  [[nodiscard]] Law at(double fraction) const;
  /// Whether the direction of the reaction turns as the axis moves.
  [[nodiscard]] bool follows_surface() const { return surface && !fixed_tangents; }
  /// @brief Penetration of a point of the axis, with its derivatives with respect to the displacement u.
  [[nodiscard]] SurfacePoint penetration(const PlaceOnAxis& at, std::array<double, 2> u) const {
    if (surface) return below_surface(at, u);
    const auto d = direction.at(at.angle);
    return {u[0] * d[0] + u[1] * d[1] - value_at(law.gap, gap_along, at.fraction), d};
  }
  /// Weights of (x, y, rotation) in the penetration. @param d direction into the medium
  [[nodiscard]] std::array<double, 3> row(const std::array<double, 2>& d) const {
    return rotational ? std::array{0.0, 0.0, d[0]} : std::array{d[0], d[1], 0.0};
  }
  /// Unit direction into the medium on the initial axis.
  [[nodiscard]] std::array<double, 2> initial_direction(const PlaceOnAxis& at) const {
    return surface ? surface->at(at.x).into : direction.at(at.angle);
  }

 private:
  [[nodiscard]] SurfacePoint below_surface(const PlaceOnAxis& at, std::array<double, 2> u) const;
};
/// Reaction law of a spring, scaled.
struct SpringLaw {
  std::array<double, 3> row{};  ///< weights of x, y and rotation in the displacement
  Law law;
  double sense = 1.0;                          ///< factor on results, see sense_of()
  std::shared_ptr<const ReactionCurve> curve;  ///< curve of `law`; null: linear
  double length = 0.0;                         ///< length of a rod (Spring::rod); 0: fixed direction
  int ground = -1;                             ///< unknown of the ground's displacement along x; -1: at rest
  /// Unknown that is the displacement at which a spring with a pretension has no force; -1: zero.
  int without_force = -1;
  std::shared_ptr<const Catenary> cable{};  ///< cable that the spring stands for; null: the law acts
  std::array<double, 2> drawn_pull{};       ///< its force as it is drawn, see NodeSpring
  double give = 0.0;                        ///< compliance of a stop whose force is an unknown; 0: none is
  int force_unknown = -1;                   ///< that unknown; -1: the law gives the force
};

/// Largest magnitude of a number along its member.
[[nodiscard]] double largest_size(const AlongMember& value);

/// @param origin of the scaled coordinates, in the model's
[[nodiscard]] FoundationLaw law_of(const Foundation& foundation, const Scales& scales,
                                   std::array<double, 2> origin = {});
[[nodiscard]] SpringLaw law_of(const Spring& spring, const Scales& scales);

}  // namespace snapthrough
