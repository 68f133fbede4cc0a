#pragma once
/// @file
/// Laws of elastic supports and of bending for the checker, written from the formulas of docs/requests.md.

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "solver/model/model.h"

namespace snapthrough::testing {

/// @brief Value at a fraction of a member: linear between the points, constant before the first and after the
/// last; `constant` without points.
/// @param power the value to the power 1 / `power` is linear
[[nodiscard]] double along(const std::vector<std::pair<double, double>>& points, double constant,
                           double fraction, double power = 1.0);

/// Points (x, f) of a table from the origin on, with the slopes of its cubic there; without slopes: straight
/// lines.
struct LawTable {
  std::vector<double> x, f, slope;
};
/// @brief Table of reactions by penetrations.
/// @pre law.type is table
[[nodiscard]] LawTable table_of(const ReactionLaw& law);

/// Reaction of a support at one place, in the model's units: an odd function of the penetration w.
struct RodLaw {
  ReactionLaw::Type type = ReactionLaw::Type::linear;
  double stiffness = 0.0, capacity = 0.0, reference = 1.0, exponent = 0.5;
  double factor = 1.0;
  std::shared_ptr<const LawTable> table;

  [[nodiscard]] double force(double w) const;
  [[nodiscard]] double slope(double w) const;
  /// @brief Penetrations w >= 0 at which a derivative of the force jumps; the same holds at -w. Nothing where
  /// the law is zero.
  [[nodiscard]] std::vector<double> kinks() const;
  /// Whether the force is proportional to w.
  [[nodiscard]] bool is_linear() const { return type == ReactionLaw::Type::linear; }
};

/// Law along a member.
class LawAlong {
 public:
  LawAlong() = default;
  explicit LawAlong(const ReactionLaw& law);
  explicit LawAlong(double stiffness) { constant_.stiffness = stiffness; }
  [[nodiscard]] RodLaw at(double fraction) const;
  [[nodiscard]] bool is_linear() const { return constant_.is_linear(); }

 private:
  RodLaw constant_;
  std::optional<ReactionLaw> varying_;  ///< the law if its numbers vary
};

/// Curvature of a section by its bending moment, in the model's units or scaled: an odd function that
/// ascends.
class BendingCurvature {
 public:
  /// @param EI bending stiffness without moment
  BendingCurvature(const BendingLaw& law, double EI);
  /// The same with moments over `moment` and curvatures over `curvature`.
  [[nodiscard]] BendingCurvature scaled(double moment, double curvature) const;

  [[nodiscard]] double at(double moment) const;
  [[nodiscard]] double slope(double moment) const;
  /// Moment of a curvature, by bisection.
  [[nodiscard]] double moment_of(double curvature) const;
  /// Largest difference of the curvature at a moment from those at moments up to `noise` away.
  [[nodiscard]] double change(double moment, double noise) const;
  /// Least and largest slope at moments up to `noise` away, where the slope is monotone between kinks.
  [[nodiscard]] std::array<double, 2> slopes_near(double moment, double noise) const;

 private:
  [[nodiscard]] std::array<double, 2> response(double moment) const;

  LawTable table_;  ///< curvatures by moments; without points: the law of Ramberg and Osgood
  double moment_ = 0.0, coefficient_ = 0.0, exponent_ = 2.0, compliance_ = 0.0;
  double moment_unit_ = 1.0, curvature_unit_ = 1.0;
};

/// @brief Slope dM / dk of a bending law's table at the origin, which is the section's EI.
/// @pre law.type is table
[[nodiscard]] double bending_stiffness_of(const BendingLaw& law);

/// @brief Law of a support in place of which a stiffness may stand.
template <class Support>
[[nodiscard]] LawAlong law_of_support(const Support& support) {
  return support.law ? LawAlong(*support.law) : LawAlong(support.stiffness);
}

}  // namespace snapthrough::testing
