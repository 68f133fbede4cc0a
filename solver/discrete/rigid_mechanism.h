#pragma once
/// @file
/// Motions of a structure of rigid members that its supports allow.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "solver/discrete/rigid_parts.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Limits of the search for motions of rigid parts.
struct MechanismLimits {
  static constexpr std::size_t motions = 24;  ///< motions searched for: those of eight unsupported bodies
  /// Sine of the angle below which two directions are parallel. Three hinges this close to a line can move,
  /// and so can a body whose supports' lines of action pass this close to one point.
  static constexpr double one_direction = 1e-6;
  /// Places of a foundation on a curved member whose displacements span those of all its places.
  static constexpr int places_on_curve = 6;
};

/// Which supports hold a structure of rigid parts.
enum class HeldBy {
  all_as_bilateral,  ///< every support, one-sided ones as bilateral
  bilateral,         ///< bilateral supports, and springs that a pretension presses
  without_capacity   ///< bilateral supports whose law has no capacity
};

/// @brief Strain-free motions that the supports of a model allow.
class RigidMechanism {
 public:
  /// @param model kept by reference
  RigidMechanism(const ResolvedModel& model, HeldBy held_by);

  [[nodiscard]] const RigidParts& parts() const { return parts_; }
  /// Orthonormal vectors over the rigid parts' unknowns.
  [[nodiscard]] const std::vector<Eigen::VectorXd>& motions() const { return motions_; }
  /// Whether the search was abandoned because the parts are connected in too many ways.
  [[nodiscard]] bool unknown() const { return unknown_; }
  /// Displacements of the nodes, (x, y, rotation) each.
  [[nodiscard]] Eigen::VectorXd of_nodes(const Eigen::VectorXd& motion) const;
  /// Index of the node with the largest displacement.
  [[nodiscard]] std::size_t node_of(const Eigen::VectorXd& motion) const;
  /// The motion on which the loads of a pattern do most work; empty when they do none.
  [[nodiscard]] std::optional<Eigen::VectorXd> driven_by(Pattern pattern) const;

 private:
  RigidParts parts_;
  std::vector<Eigen::VectorXd> motions_;
  bool unknown_ = false;
};

}  // namespace snapthrough
