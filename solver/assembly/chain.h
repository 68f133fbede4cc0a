#pragma once
/// @file
/// Elimination of the nodes inside a member, in mixed form.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/element/element_set.h"

namespace snapthrough {

/// @brief Number of negative eigenvalues of [[-F, I], [I, K]] beyond the three that F = K = 0 has.
[[nodiscard]] int extra_negative(const Eigen::Matrix3d& F, const Eigen::Matrix3d& K);

/// @brief Condenses the elements of one member, one after the other, to its two ends.
///
/// The elements up to node e act on (u_s, m_e), u_s the displacement of the member's start and m_e the force
/// through node e, as   K u_s + X^T m = r_s,   X u_s - F m + u_e = r_m.   The next element is (K', X', F') on
/// (u_e, m'). The pair (m_e, u_e) has the pivot [[-F, I], [I, K']], so with M = (I + K' F)^-1
///
///   m = M (c2 - X'^T m' - K' (c1 - X u_s)),    u_e = c1 - X u_s + F m,
///
/// c1, c2 the right-hand sides of the two rows. Flexibilities are never inverted: F = 0 is an inextensible,
/// rigid part.
class Chain {
 public:
  /// @brief Eliminates all inner nodes of `elements` (one member, in order, not empty).
  void factorise(std::span<const CondensedElement> elements);
  /// @brief Right-hand side at the ends (ends().ra, ends().rm), from the elements' ra, rm and the node rows
  /// of `rhs`.
  void reduce(std::span<const CondensedElement> elements, std::span<const ElementDofs> dofs,
              const Eigen::VectorXd& rhs);
  /// @brief Writes the solution at the inner nodes and the multipliers into `x`, which holds it already at
  /// the start (first element's a) and in the last element's multiplier.
  void recover(std::span<const CondensedElement> elements, std::span<const ElementDofs> dofs,
               Eigen::VectorXd& x) const;

  [[nodiscard]] const CondensedElement& ends() const { return ends_; }

 private:
  struct Node {
    Eigen::Matrix3d X, F, M;
    Eigen::Vector3d c1, c2;
  };
  std::vector<Node> nodes_;
  CondensedElement ends_;
};

}  // namespace snapthrough
