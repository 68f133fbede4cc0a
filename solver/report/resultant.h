#pragma once
/// @file
/// Resultants of forces on a structure, by their virtual work on its three rigid motions.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// A resultant in scaled units, moment about the axes' origin (the first node).
using Wrench = std::array<double, 3>;

/// @brief The rigid motions of a structure on its mesh at one state: translations along x and y and the
/// rotation about the axes' origin.
///
/// A rigid motion strains no element, so the internal forces do no work on it, and in equilibrium the works
/// of all loads, reactions, springs and foundations add up to zero to rounding, whatever the mesh. Positions
/// are those of the mesh's own axis: exact at the ends of elements, between them of the elements' order.
class RigidMotions {
 public:
  /// @param structure kept by reference, must outlive this
  /// @param y unknowns; with a linear geometry positions are undeformed
  RigidMotions(const Structure& structure, const Model& model, const Eigen::VectorXd& y);

  /// Work of forces given as a vector of the problem's rows (right-hand side).
  [[nodiscard]] Wrench work(const Eigen::VectorXd& forces) const;
  /// A functional's values: what a unit force along it has as its resultant.
  [[nodiscard]] Wrench work(const SparseRow& row) const;
  /// @param support its spring is not looked at
  [[nodiscard]] Wrench work(const SupportSpring& support) const;
  /// What a support reads from unknowns, and the size of the displacement that it starts from.
  struct Reading {
    double value = 0.0;
    double size = 0.0;
  };
  [[nodiscard]] Reading value(const SupportSpring& support, const Eigen::VectorXd& y) const;

  /// The model's units, moment about the origin of the model's axes.
  [[nodiscard]] Resultant unscaled(const Wrench& scaled) const;

 private:
  const Structure& structure_;
  Eigen::VectorXd x_, y_;     ///< ones at the rows of translations
  Eigen::VectorXd rotation_;  ///< displacements of a unit rotation about the axes' origin
};

}  // namespace snapthrough
