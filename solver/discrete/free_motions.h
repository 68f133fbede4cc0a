#pragma once
/// @file
/// Motions that nothing but one-sided supports can resist.

#include <Eigen/Core>
#include <memory>

#include "solver/discrete/rigid_mechanism.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief Motions without strain of a structure without its one-sided supports. Opposite ones that touch act
/// as one support of both sides (with_joined_supports()) and stay.
class FreeMotions {
 public:
  /// @param model kept by reference
  /// @pre the model passed check()
  explicit FreeMotions(const Model& model);

  [[nodiscard]] bool empty() const { return motions_.cols() == 0; }
  /// Unknowns of parts() by motion, orthonormal columns. At most kMostMotions.
  [[nodiscard]] const Eigen::MatrixXd& motions() const { return motions_; }
  /// @pre not empty
  [[nodiscard]] const RigidParts& parts() const { return mechanism_->parts(); }
  /// The model with its opposite supports joined: nodes, members and loads are the model's own.
  /// @pre not empty
  [[nodiscard]] const Model& joined_model() const { return parts().model(); }
  /// @brief Displacements of the nodes (x, y over the longest member's length, rotation): orthonormal columns
  /// that span those of the motions; without columns when there are none.
  [[nodiscard]] Eigen::MatrixXd of_nodes() const;

 private:
  std::unique_ptr<const Model> joined_;  ///< null: nothing is opposite
  std::unique_ptr<const RigidMechanism> mechanism_;
  Eigen::MatrixXd motions_;
};

/// @brief FreeMotions::of_nodes() of a model.
/// @pre the model passed check()
[[nodiscard]] Eigen::MatrixXd free_motions(const Model& model);

}  // namespace snapthrough
