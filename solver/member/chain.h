#pragma once
/// @file
/// Condensation of the elements of a member to its ends, in mixed form.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/element/element_set.h"
#include "solver/numeric/small_factor.h"

namespace snapthrough {

/// @brief Number of negative eigenvalues of [[-F, I], [I, K]] minus three, the number for F = K = 0.
[[nodiscard]] int extra_negative(const Eigen::Matrix3d& F, const Eigen::Matrix3d& K);

/// @brief Condenses the elements of one member to its two ends.
///
/// A run of elements from node s to node e acts on its start displacement u_s and its end force m_e as   K
/// u_s + X^T m_e = r_s,   X u_s - F m_e + u_e = r_m.   Two runs are joined by eliminating (m_e, u_e) at their
/// common node, with the pivot [[-F, I], [I, K']] (primes: second run). With M = (I + K' F)^-1
///
///   m_e = M (c2 - X'^T m' - K' (c1 - X u_s)),    u_e = c1 - X u_s + F m_e,
///
/// with c1, c2 the right-hand sides of the two rows. Flexibilities are not inverted, so that F = 0 represents
/// a rigid part. M is not formed: at stiff supports K' is large and M small, and K' would multiply the
/// rounding of M.
///
/// Runs are joined from the member's start. The pivot is singular when both runs together, clamped at the
/// start and free at the end, are at a buckling load, which may coincide with the load of interest (half of a
/// pinned column is a cantilever). At a poor pivot, up to four next elements are joined to each other first.
class Chain {
 public:
  /// @brief Eliminates all inner nodes of `elements` (those of one member, in order, not empty).
  void factorise(std::span<const CondensedElement> elements);
  /// @brief Returns the right-hand sides at the ends, from those of the elements and the node rows of `rhs`.
  /// Overwrites those of the elements with the data of recover().
  [[nodiscard]] CondensedForces reduce(std::span<CondensedForces> elements, std::span<const ElementDofs> dofs,
                                       const ColumnLanes& rhs) const;
  /// @brief Writes the solution at the inner nodes and the multipliers into `x`, given the solution at the
  /// start (first element's a) and the last element's multiplier.
  /// @param elements as left by reduce()
  void recover(std::span<const CondensedForces> elements, std::span<const ElementDofs> dofs,
               const ColumnLanes& x) const;

  [[nodiscard]] const CondensedElement& ends() const { return ends_; }

 private:
  /// A run of elements.
  struct Run {
    Eigen::Matrix3d K, X, F;
    int first = 0, last = 0;
  };
  /// Join of two runs at the start of element `second_first`.
  struct Join {
    int first_first = 0, second_first = 0, second_last = 0;
    Eigen::Matrix3d X, F;    ///< matrices of the first run
    Eigen::Matrix3d K2, X2;  ///< matrices of the second run
    SmallFactor pivot;
  };
  /// Pivot I + K' F of a join.
  struct Pivot {
    SmallFactor factor;
    double gain = 0.0;     ///< largest entry of the inverse: amplification of errors
    double quality = 0.0;  ///< reciprocal condition number: 1 is best, 0 is singular
  };
  [[nodiscard]] static Pivot pivot_of(const Run& first, const Run& second);
  void join(Run& first, const Run& second, const Pivot& pivot);
  void join_next(Run& all, std::span<const CondensedElement> elements);

  std::vector<Join> joins_;
  CondensedElement ends_;
};

}  // namespace snapthrough
