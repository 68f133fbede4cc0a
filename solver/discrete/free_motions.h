#pragma once
/// @file
/// Rigid-body motions that only one-sided supports can resist.

#include <Eigen/Core>
#include <memory>

#include "solver/discrete/rigid_mechanism.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Strain-free motions of a structure without its one-sided supports, or without those and the
/// supports with a capacity. Opposite supports that touch act as one bilateral support
/// (with_joined_supports()) and remain.
class FreeMotions {
 public:
  /// @param model kept by reference
  /// @pre the model passed check()
  explicit FreeMotions(const ResolvedModel& model, HeldBy held_by = HeldBy::bilateral);

  [[nodiscard]] bool empty() const { return motions_.cols() == 0; }
  /// Orthonormal columns over the unknowns of parts(); at most MechanismLimits::motions.
  [[nodiscard]] const Eigen::MatrixXd& motions() const { return motions_; }
  /// @pre not empty
  [[nodiscard]] const RigidParts& parts() const { return mechanism_->parts(); }
  /// The model with opposite supports joined; its nodes, members and loads are those of the model.
  /// @pre not empty
  [[nodiscard]] const ResolvedModel& joined_model() const { return parts().model(); }
  /// @brief Node displacements (x, y over the longest member's length, rotation) of the motions: orthonormal
  /// columns with the same span; no columns when there are none.
  [[nodiscard]] Eigen::MatrixXd of_nodes() const;
  /// @brief Node displacements (x, y over the longest member's length, rotation) of one motion.
  /// @param motion over the unknowns of parts()
  /// @pre not empty
  [[nodiscard]] Eigen::VectorXd of_nodes(const Eigen::VectorXd& motion) const {
    return mechanism_->of_nodes(motion);
  }

 private:
  std::unique_ptr<const ResolvedModel> joined_;  ///< null: no supports are opposite
  std::unique_ptr<const RigidMechanism> mechanism_;
  Eigen::MatrixXd motions_;
};

/// @brief FreeMotions::of_nodes() of a model.
/// @pre the model passed check()
[[nodiscard]] Eigen::MatrixXd free_motions(const ResolvedModel& model);

}  // namespace snapthrough
