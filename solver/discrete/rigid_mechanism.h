#pragma once
/// @file
/// Motions of a structure of rigid members that its supports do not resist.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "solver/discrete/rigid_parts.h"
#include "solver/model/model.h"

namespace snapthrough {

/// Most motions that are looked for: eight bodies that nothing holds.
inline constexpr std::size_t kMostMotions = 24;

/// @brief The motions that a structure does not resist.
class RigidMechanism {
 public:
  /// @param model kept by reference
  /// @param one_sided whether supports that act on one side only are there (they count as glued)
  RigidMechanism(const Model& model, bool one_sided);

  [[nodiscard]] const RigidParts& parts() const { return parts_; }
  /// One vector of the rigid parts' unknowns a motion, orthonormal.
  [[nodiscard]] const std::vector<Eigen::VectorXd>& motions() const { return motions_; }
  /// Whether the parts are connected in too many ways to tell.
  [[nodiscard]] bool unknown() const { return unknown_; }
  /// Displacements of the nodes (x, y, rotation each).
  [[nodiscard]] Eigen::VectorXd of_nodes(const Eigen::VectorXd& motion) const;
  /// The node that moves most.
  [[nodiscard]] std::size_t node_of(const Eigen::VectorXd& motion) const;
  /// The motion on which the loads of a pattern do work, if they do on any.
  [[nodiscard]] std::optional<Eigen::VectorXd> driven_by(Pattern pattern) const;

 private:
  RigidParts parts_;
  std::vector<Eigen::VectorXd> motions_;
  bool unknown_ = false;
};

}  // namespace snapthrough
