#pragma once
/// @file
/// Resultants of forces on a structure, by their virtual work on its rigid-body motions.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Resultant (x, y, moment about the origin of the scaled axes) in scaled units.
using Wrench = std::array<double, 3>;

/// @brief Rigid-body motions of a structure at one state: two translations and the rotation about the origin.
///
/// Internal forces do no work on rigid-body motions. In equilibrium the works of loads, reactions, springs
/// and foundations therefore sum to zero up to rounding on any mesh. Positions are those of the mesh's axis:
/// exact at element ends, of the elements' order between them.
class RigidMotions {
 public:
  /// @param structure kept by reference; must outlive this object
  /// @param y unknowns; ignored for a linear geometry, whose positions are undeformed
  RigidMotions(const Structure& structure, const Eigen::VectorXd& y);

  /// Work of forces given in the rows of the problem (right-hand side).
  [[nodiscard]] Wrench work(const Eigen::VectorXd& forces) const;
  /// Likewise, with the magnitudes of all terms added.
  [[nodiscard]] Wrench work_without_sign(const Eigen::VectorXd& forces) const;
  /// Resultant of a unit force along a functional.
  [[nodiscard]] Wrench work(const SparseRow& row) const;
  /// @param support its stiffness is ignored
  [[nodiscard]] Wrench work(const SupportSpring& support) const;
  /// Value of a support's functional, and the magnitude of the displacements it is computed from.
  struct Reading {
    double value = 0.0;
    double size = 0.0;
  };
  [[nodiscard]] Reading value(const SupportSpring& support, const Eigen::VectorXd& y) const;

  /// Largest distance between the ends of members that meet at a node. Mode imperfections move each end along
  /// its own normal; the node passes forces from one to the other without the moment of that distance.
  [[nodiscard]] double apart() const { return apart_; }
  /// Converts to the model's units, with the moment about the origin of the model's axes.
  [[nodiscard]] Resultant unscaled(const Wrench& scaled) const;

 private:
  const Structure& structure_;
  Eigen::VectorXd x_, y_;     ///< ones at the rows of the translations
  Eigen::VectorXd rotation_;  ///< displacements of a unit rotation about the origin
  double apart_ = 0.0;
};

}  // namespace snapthrough
