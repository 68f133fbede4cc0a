#pragma once
/// @file
/// Work of loads on the motions of rigid parts.

#include <Eigen/Core>

#include "solver/discrete/rigid_parts.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Work of an action as a linear functional of the rigid parts' unknowns, on the undeformed geometry.
struct LoadWork {
  /// Work of the action, in the model's unit of force; an unknown may occur several times.
  RigidParts::Row row;
  double size = 0.0;  ///< sum of the magnitudes of its forces, and of its moment over the unit of length
};

/// @brief Work of one action at its full size. Initial strains do no work.
[[nodiscard]] LoadWork work_of(const RigidParts& parts, const Action& action);

/// @brief Forces of all loads of one pattern on the rigid parts' unknowns. Prescribed displacements count as
/// fixed and exert none.
class RigidLoads {
 public:
  RigidLoads(const RigidParts& parts, Pattern pattern);

  /// One force per unknown.
  [[nodiscard]] const Eigen::VectorXd& forces() const { return forces_; }
  /// Sum of the magnitudes of all forces.
  [[nodiscard]] double size() const { return size_; }

 private:
  Eigen::VectorXd forces_;
  double size_ = 0.0;
};

}  // namespace snapthrough
