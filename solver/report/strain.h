#pragma once
/// @file
/// Largest strains, for the limits of the small-strain constitutive law.

#include <Eigen/Core>
#include <numbers>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Limits of the theory's range. Strains without unit, at the outer fibre; rotations in rad.
struct StrainLimits {
  /// Strain above which strain measures differ by some per cent and few materials are linear.
  static constexpr double small = 0.05;
  static constexpr double largest = 1.0;  ///< a fibre is compressed to zero length
  static constexpr double largest_rotation = 10.0 * std::numbers::pi;  ///< rotation of an element: five turns
};

/// Largest strain of a state, with its member and position.
struct LargestStrain {
  double strain = 0.0;
  std::string member;  ///< id
  double s = 0.0;      ///< arc length in the model's units
};

/// @brief Evaluates strains at the elements' Gauss points from the section forces, and those of rods.
///
/// A strain is the largest of |N| / EA, |Q| / GA and |k| sqrt(EI / EA) with the curvature k; the last is a
/// lower bound of the bending strain in the outer fibre, for any section depth.
class StrainGauge {
 public:
  /// @param structure kept by reference; must outlive this object
  explicit StrainGauge(const Structure& structure);
  /// Replaces `largest` if a strain at y exceeds it; returns true in that case.
  [[nodiscard]] bool raise(const Eigen::VectorXd& y, LargestStrain& largest) const;
  /// Whether y is outside the theory: a fibre strain reaches 1 (compression to zero length), or an element
  /// has rotated by five turns, after which its member would intersect itself.
  [[nodiscard]] bool is_beyond_theory(const Eigen::VectorXd& y) const;

 private:
  /// Strains at a place by the section forces of one unit there.
  struct Compliance {
    double axial, shear, bending;
  };
  [[nodiscard]] Compliance compliance_at(const MeshElement& cell, double fraction) const;
  /// Bending law of a member; null: none.
  [[nodiscard]] const BendingCurve* curve_of(int member) const;

  const Structure& structure_;
  const ResolvedModel& model_;
  std::vector<const Section*> sections_;  ///< one per member
};

}  // namespace snapthrough
