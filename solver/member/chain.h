#pragma once
/// @file
/// Elimination of the nodes inside a member, in mixed form.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/element/element_set.h"
#include "solver/numeric/small_factor.h"

namespace snapthrough {

/// @brief Number of negative eigenvalues of [[-F, I], [I, K]] beyond the three that F = K = 0 has.
[[nodiscard]] int extra_negative(const Eigen::Matrix3d& F, const Eigen::Matrix3d& K);

/// @brief Condenses the elements of one member to its two ends.
///
/// A run of elements from node s to node e acts on (u_s, m_e), u_s the displacement of its start and m_e the
/// force through its end, as   K u_s + X^T m_e = r_s,   X u_s - F m_e + u_e = r_m.   Two runs are joined by
/// eliminating (m_e, u_e) at the node between them, whose pivot is [[-F, I], [I, K']] (primes: the second
/// run). With M = (I + K' F)^-1
///
///   m_e = M (c2 - X'^T m' - K' (c1 - X u_s)),    u_e = c1 - X u_s + F m_e,
///
/// c1, c2 the right-hand sides of the two rows. Flexibilities are never inverted: F = 0 is an inextensible,
/// rigid part. Nor is M formed: where a support is stiff K' is large and M small across its direction, and
/// what an inverse has lost there would be multiplied by K'.
///
/// Runs are joined from the start of the member on. A pivot is singular when the two runs together, held at
/// their start and free at their end, are at a buckling load of their own; that may be the very load that is
/// looked for (half of a pinned column is a cantilever). Where a pivot is poor, the next elements, four at
/// most, are joined to one another first.
class Chain {
 public:
  /// @brief Eliminates all inner nodes of `elements` (one member, in order, not empty).
  void factorise(std::span<const CondensedElement> elements);
  /// @brief Right-hand side at the ends (ends().ra, ends().rm), from the elements' ra, rm and the node rows
  /// of `rhs`. The elements' ra, rm become what recover() needs: no vectors are kept for it.
  void reduce(std::span<CondensedElement> elements, std::span<const ElementDofs> dofs,
              const Eigen::VectorXd& rhs);
  /// @brief Writes the solution at the inner nodes and the multipliers into `x`, which holds it already at
  /// the start (first element's a) and in the last element's multiplier.
  /// @param elements as reduce() left them
  void recover(std::span<const CondensedElement> elements, std::span<const ElementDofs> dofs,
               Eigen::VectorXd& x) const;

  [[nodiscard]] const CondensedElement& ends() const { return ends_; }

 private:
  /// A run of elements.
  struct Run {
    Eigen::Matrix3d K, X, F;
    int first = 0, last = 0;
  };
  /// The join of two runs at the start of element `second_first`.
  struct Join {
    int first_first = 0, second_first = 0, second_last = 0;
    Eigen::Matrix3d X, F;    ///< of the first run
    Eigen::Matrix3d K2, X2;  ///< of the second run
    SmallFactor pivot;
  };
  /// Pivot I + K' F of a join.
  struct Pivot {
    SmallFactor factor;
    double gain = 0.0;     ///< largest entry of the inverse: what errors of the runs are multiplied by
    double quality = 0.0;  ///< reciprocal condition: 1 is perfect, 0 singular
  };
  [[nodiscard]] static Pivot pivot_of(const Run& first, const Run& second);
  void join(Run& first, const Run& second, const Pivot& pivot);
  void join_next(Run& all, std::span<const CondensedElement> elements);

  std::vector<Join> joins_;
  CondensedElement ends_;
};

}  // namespace snapthrough
