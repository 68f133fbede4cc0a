#pragma once
/// @file
/// The equations of the nodes of a structure, to which its members are condensed.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/member/chain.h"
#include "solver/numeric/symmetric_indefinite.h"
#include "solver/problem/equilibrium_problem.h"
#include "solver/problem/joint_work.h"
#include "solver/problem/node_spring_work.h"
#include "solver/problem/support_axes.h"

namespace snapthrough {

/// @brief Factorises the tangent of a structure from the condensed tangents of its elements.
///
/// The nodes inside members are eliminated first (Chain). Nodal displacements, released rotations and member
/// end forces remain, in a sparse symmetric system with one block per part of a member between nodes:
///
///   [ K_s + springs   X^T   .  ] [u_nodes]
///   [ X               -F    I  ] [m_member]     (I acts on its end node)
///
/// and a block for each stop of a row g
///
///   [ .   g  ] [u_node]
///   [ g^T -c ] [force ]      (see problem/node_spring_work.h)
///
/// Holds k H H^T add a block with one unknown force per motion: [ . sqrt(k) H ; . -1 ].
///
/// The negative eigenvalues of the constrained displacement stiffness number the negative pivots of all
/// levels minus one for each stress and multiplier (Haynsworth's inertia formula).
class NodeSystem {
 public:
  /// @param structure, axes kept by reference; must outlive this object
  NodeSystem(const Structure& structure, const SupportAxes& axes);

  /// Adds the artificial springs of `holds` to the tangent from the next factorise() on; null removes them.
  void set_holds(const SharedHolds& holds);
  /// @brief Factorises the tangent stiffness of all nodes, for solve(), and counts its negative eigenvalues.
  /// @param condensed one entry per element
  TangentReport factorise(std::span<const CondensedElement> condensed, const NodeSpringWork& springs,
                          const JointWork& joints);
  /// @brief x := K^-1 x. Couplings of elements and loads that follow are no part of K.
  /// @param elements hold the factors of their interiors
  void solve(ElementWork& elements, Eigen::Ref<Eigen::MatrixXd> x);

 private:
  void plan();
  void assemble(const NodeSpringWork& springs, const JointWork& joints);
  void fill_part(std::size_t part, Eigen::MatrixXd& block) const;
  void fill_spring(const NodeSpringWork& springs, std::size_t spring, Eigen::MatrixXd& block) const;
  void fill_hold(int node, Eigen::MatrixXd& block) const;
  void reduce_part(std::size_t part, const ColumnLanes& lanes, Eigen::Index count);
  void solve_nodes(Eigen::Ref<Eigen::VectorXd> rhs, Eigen::Ref<Eigen::VectorXd> reduced);
  void recover_part(std::size_t part, const ColumnLanes& lanes, Eigen::Ref<Eigen::MatrixXd> x) const;
  void subtract_fixed(const Eigen::Ref<const Eigen::VectorXd>& rhs,
                      Eigen::Ref<Eigen::VectorXd> reduced) const;
  /// First row of the end forces of a part of a member between nodes; displacements and forces of stops keep
  /// their index.
  [[nodiscard]] Eigen::Index multiplier(std::size_t part) const {
    return structure_.before_elements() + DofMap::count(static_cast<Eigen::Index>(part));
  }
  /// First element of a part of a member between nodes.
  [[nodiscard]] int first_of(std::size_t part) const { return structure_.parts_between_nodes[part]; }
  /// Entries of a list with one entry per element that belong to a part.
  template <class List>
  [[nodiscard]] auto of_part(List& list, std::size_t part) const {
    const auto first = static_cast<std::size_t>(first_of(part));
    return std::span(list).subspan(first, static_cast<std::size_t>(first_of(part + 1)) - first);
  }

  const Structure& structure_;
  const SupportAxes& axes_;
  std::size_t parts_;          ///< number of parts of members between nodes
  std::vector<Chain> chains_;  ///< one per part
  std::vector<CondensedForces> condensed_forces_;
  std::vector<Eigen::Index> free_;       ///< rows that are unknown
  std::vector<std::vector<int>> rows_;   ///< rows of each block
  std::vector<Eigen::MatrixXd> blocks_;  ///< blocks of members, node springs, joints and held nodes
  SymmetricIndefinite factor_;
  Eigen::MatrixXd node_rhs_, free_rhs_;  ///< scratch of solve()
  SharedHolds holds_;
  Eigen::MatrixXd hold_rows_;  ///< sqrt(k) H in the support axes
  bool planned_ = false;       ///< rows_ and factor_ include the holds
};

}  // namespace snapthrough
