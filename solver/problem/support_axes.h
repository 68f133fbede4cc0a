#pragma once
/// @file
/// The axes in which supports hold nodes, and the components that they hold.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/discrete/structure.h"

namespace snapthrough {

/// @brief Turns the unknowns of nodes between global axes and those of the supports.
///
/// Only inclined supports have axes of their own. Vectors are those of all unknowns; rows that belong to no
/// node remain.
class SupportAxes {
 public:
  /// @param structure kept by reference; must outlive this object
  explicit SupportAxes(const Structure& structure);

  /// Whether a support holds an unknown, or nothing resists it: a rotation of a node without stiffness.
  [[nodiscard]] bool is_fixed(Eigen::Index unknown) const;
  /// The unknowns that are fixed, ascending.
  [[nodiscard]] const std::vector<Eigen::Index>& fixed() const { return fixed_; }
  /// Axes of the support at an end of an element as columns, in global components.
  [[nodiscard]] Eigen::Matrix3d axes_of(const std::array<int, 3>& dofs) const;
  /// Displacement and rotation of a node along the axes of its support.
  [[nodiscard]] Eigen::Vector3d components(const Eigen::Ref<const Eigen::VectorXd>& y, int node) const;
  /// Turns the rows of nodes to the axes of the supports.
  void to_supports(Eigen::Ref<Eigen::VectorXd> f) const;
  /// Turns the rows of nodes from the axes of the supports.
  void from_supports(Eigen::Ref<Eigen::VectorXd> x) const;
  /// Sets the fixed rows to zero and turns the others to the axes of the supports.
  void release(Eigen::Ref<Eigen::VectorXd> f) const;
  /// The displacements that the fixed rows prescribe, in global axes; zero elsewhere.
  [[nodiscard]] Eigen::VectorXd imposed_motion(const Eigen::VectorXd& rows) const;
  /// Work of forces, in the axes of the supports, on a motion in global axes.
  [[nodiscard]] double work(const Eigen::Ref<const Eigen::VectorXd>& forces,
                            const Eigen::Ref<const Eigen::VectorXd>& motion) const;

 private:
  [[nodiscard]] std::array<double, 2> turn_of(int unknown) const;
  void find_free_rotations();

  const Structure& structure_;
  std::vector<std::array<double, 2>> turns_;  ///< cosine and sine of the support angle at each node
  std::vector<int> inclined_;                 ///< nodes with an inclined support
  std::vector<char> free_rotation_;  ///< node rotations without stiffness: all members are released there
  std::vector<Eigen::Index> fixed_;
};

}  // namespace snapthrough
