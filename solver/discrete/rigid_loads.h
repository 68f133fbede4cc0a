#pragma once
/// @file
/// Work of loads on the motions of rigid parts.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "solver/discrete/rigid_parts.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Work of a load as a linear functional of the rigid parts' unknowns, on the undeformed geometry.
struct LoadWork {
  Pattern pattern = Pattern::proportional;
  std::string name;  ///< name of the load, for messages
  /// Work of the load, in the model's unit of force; an unknown may occur several times.
  RigidParts::Row row;
  double size = 0.0;  ///< sum of the magnitudes of its forces, and of its moment over the unit of length
};

/// @brief Work of each load of the parts' model at its full size, in the order of the loads. Initial strains
/// do no work.
[[nodiscard]] std::vector<LoadWork> works_of_loads(const RigidParts& parts);

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
