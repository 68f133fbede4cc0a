#pragma once
/// @file
/// Artificial springs ("holds") that pin motions without stiffness.

#include <Eigen/Core>
#include <memory>

namespace snapthrough {

/// @brief Artificial linear springs on motions without stiffness: forces k H (H^T u - at), u leading
/// unknowns.
///
/// Where nothing resists the motions H, all states u + H a are in equilibrium. The springs select the state
/// with H^T u = at, carry no force there, and make the zero eigenvalues positive, so that the number of
/// negative eigenvalues is that of the other motions. A spring with a force pins a motion that has stiffness.
struct Holds {
  Eigen::MatrixXd motions;  ///< H: orthonormal columns over the leading unknowns
  Eigen::VectorXd at;
  double stiffness = 1.0;  ///< k, of the order of the problem's scaled stiffnesses
};

/// Holds shared by the points of a path; null: no motion is held.
using SharedHolds = std::shared_ptr<const Holds>;

}  // namespace snapthrough
