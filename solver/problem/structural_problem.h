#pragma once
/// @file
/// The equilibrium problem of a structure.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/member/chain.h"
#include "solver/numeric/symmetric_indefinite.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief Mixed equilibrium equations of a Structure, factorised in three levels.
///
/// Element interiors (ElementSet), then the nodes inside members (Chain), then a sparse symmetric system for
/// the nodes' displacements, released rotations and the forces at members' ends, one block a member:
///
///   [ K_s + springs   X^T   .  ] [u_nodes]
///   [ X               -F    I  ] [m_member]     (I acts on its end node)
///
/// Holds, k H H^T, are blocks with an unknown force of each: [ . sqrt(k) H ; . -1 ].
///
/// Rows of a node with a turned support, and of its fixed components, are in the support's axes; a fixed
/// component's row is u - lambda d - d_0. The inertia is the sum over the levels minus one negative for each
/// stress and multiplier (Haynsworth), so it counts the negative eigenvalues of the constrained displacement
/// stiffness.
///
/// residual(), linearise() and tangent_products() look at the structure's stop token and throw Cancelled
/// once.
class StructuralProblem final : public EquilibriumProblem {
 public:
  /// @param structure kept by reference, must outlive this
  explicit StructuralProblem(const Structure& structure);

  [[nodiscard]] Eigen::Index size() const override { return structure_.size; }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return structure_.metric; }
  void load(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& out) override;
  void solve(Eigen::VectorXd& x) override;
  [[nodiscard]] double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd& y,
                                         double lambda) override;
  [[nodiscard]] double residual_rounding(const Eigen::VectorXd& y, double lambda) const override;

  [[nodiscard]] bool one_sided() const override { return structure_.one_sided; }
  [[nodiscard]] MovingZones moving_zones(const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& rate) const override;
  [[nodiscard]] double missed_contact(const FrozenContact& frozen, const Eigen::VectorXd& y) const override;
  [[nodiscard]] FrozenContact freeze(const MovingZones& zones, const Eigen::VectorXd& y) const override;
  [[nodiscard]] const Eigen::MatrixXd& free_motions() const override { return structure_.free_motions; }
  void set_holds(const SharedHolds& holds) override;
  void force_along(const Eigen::VectorXd& motion, Eigen::VectorXd& out) const override;
  /// Euler's load of the most compressed member: pi^2 EI / (N l^2).
  [[nodiscard]] double critical_load_scale(const Eigen::VectorXd& unit_response) const override;
  [[nodiscard]] double largest_critical_load_scale(const Eigen::VectorXd& unit_response) const override;
  /// @brief Least section force in the response to a unit load of the stage at hand that is not rounding.
  /// Zero where nothing imposes strains or displacements: then all forces are the loads'.
  [[nodiscard]] double least_force() const;

  /// What the load factor multiplies: the proportional actions, with the constant ones on; or, to put these
  /// on, the constant ones alone.
  enum class Stage { proportional, constant };
  void set_stage(Stage stage) { stage_ = stage; }
  void metric_forces(const Eigen::VectorXd& x, Eigen::VectorXd& out) const override;
  [[nodiscard]] Eigen::VectorXd imposed_motion(const Eigen::VectorXd& rows) const override;
  [[nodiscard]] double work(const Eigen::VectorXd& forces, const Eigen::VectorXd& motion) const override;
  /// @brief One-sided supports glued where they touch at y, absent elsewhere.
  [[nodiscard]] FrozenContact frozen_contact(const Eigen::VectorXd& y) const;
  /// @brief The one-sided supports that touch without pressure at y: no further from touching than 1e-9 of
  /// the largest displacement and 1e-6 of the largest force, foundations on all of their part of an element.
  [[nodiscard]] TouchingMarks marks_at(const Eigen::VectorXd& y) const;
  /// @brief Displacement of each touching spring into its medium.
  void touching_displacements(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                              std::vector<double>& out) const;
  /// @brief Of the supports that touch these springs act, and foundations where `mode` moves into them.
  /// @param mode empty: foundations act wherever they touch
  /// @param springs one a touching spring
  void set_touching(const TouchingMarks& marks, const Eigen::VectorXd& mode, std::span<const char> springs,
                    FrozenContact& out) const;
  /// As set_touching() left them. @param frozen null: none acts
  [[nodiscard]] TouchingSupports touching(const TouchingMarks& marks, const FrozenContact* frozen) const;
  [[nodiscard]] std::size_t touching_springs(const TouchingMarks& marks) const;

 protected:
  /// Small displacements where the regime or the structure says so.
  void find_residual(const Eigen::VectorXd& y, double lambda, const Regime& asked,
                     Eigen::VectorXd& f) override;
  TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& asked,
                          Eigen::VectorXd& f) override;
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double lambda, const Regime& asked,
                                              const Eigen::Ref<const Eigen::MatrixXd>& directions) override;

 private:
  [[nodiscard]] double largest_axial_force(std::size_t member, const Eigen::VectorXd& response) const;
  /// x := S^-1 x with the symmetric part S of the tangent.
  void solve_symmetric(Eigen::VectorXd& x);
  void add_follower_ends(double lambda, TangentReport& report);
  /// Factors on the proportional and the constant actions at a load factor.
  [[nodiscard]] LoadFactors factors(double lambda) const {
    return stage_ == Stage::proportional ? LoadFactors{lambda, 1.0} : LoadFactors{0.0, lambda};
  }
  [[nodiscard]] Regime regime_of(const Regime& asked) const;
  [[nodiscard]] TouchingDistance touching_distance(const Eigen::VectorXd& y) const;
  void start_residual(double lambda, Eigen::VectorXd& f) const;
  void turn_to_supports(Eigen::Ref<Eigen::VectorXd> f) const;
  void add_node_products(double lambda, const Eigen::Ref<const Eigen::VectorXd>& direction,
                         Eigen::Ref<Eigen::VectorXd> out) const;
  [[nodiscard]] double penetration(const NodeSpring& spring, const Eigen::VectorXd& y, double gap) const;
  [[nodiscard]] static bool node_spring_acts(const NodeSpring& spring, double w);
  double node_spring_force(std::size_t index, const Eigen::VectorXd& y, const Regime& regime);
  void add_node_springs(const Eigen::VectorXd& y, const Regime& regime, Eigen::VectorXd& f);
  void add_holds(const Eigen::VectorXd& y, Eigen::VectorXd& f) const;
  /// Of the loads and of the members' ends.
  /// The largest of the rows that are forces or moments; the others are displacements and strains.
  [[nodiscard]] double force_norm(const Eigen::VectorXd& f) const;
  [[nodiscard]] double largest_force(const Eigen::VectorXd& y, double lambda) const;
  [[nodiscard]] double imposed_force(double lambda) const;
  [[nodiscard]] double force_scale(const Eigen::VectorXd& y, double lambda) const;
  void constrain_residual(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& f) const;
  void plan_nodes();
  void assemble_nodes();
  void fill_member(std::size_t member, Eigen::MatrixXd& block) const;
  /// Moves what is fixed to the right-hand side.
  void subtract_fixed(const Eigen::VectorXd& rhs, Eigen::VectorXd& reduced) const;
  /// Position of a displacement unknown's scalar in the node system is its index; multipliers follow.
  [[nodiscard]] Eigen::Index multiplier(std::size_t member) const {
    return 3 * structure_.nodes + structure_.releases + 3 * static_cast<Eigen::Index>(member);
  }
  [[nodiscard]] std::array<double, 2> turn_of(int dof) const;
  [[nodiscard]] Eigen::Matrix3d axes_of(const std::array<int, 3>& dofs) const;
  [[nodiscard]] bool is_fixed(Eigen::Index scalar) const;

  const Structure& structure_;
  std::stop_token stop_;
  std::size_t members_;
  std::vector<CondensedElement> condensed_;
  std::vector<Chain> chains_;
  std::vector<Eigen::Index> free_;  ///< node scalars and multipliers that are unknown
  std::vector<Eigen::Index> fixed_;
  std::vector<std::vector<int>> node_rows_;   ///< scalars of each block of the node system
  std::vector<Eigen::MatrixXd> node_blocks_;  ///< of members, node springs, nodes that are held
  std::vector<char> free_rotation_;  ///< node rotations that nothing holds: all members released there
  bool planned_ = false;             ///< node_rows_ and factor_ know the holds
  SymmetricIndefinite factor_;
  Eigen::VectorXd node_rhs_, free_rhs_;  ///< scratch of solve
  FollowerEnds follower_ends_;
  std::unique_ptr<ElementWork> elements_;
  std::vector<double> spring_stiffness_;  ///< of each spring at a node, as add_node_springs() found it last
  SharedHolds holds_;
  Eigen::MatrixXd hold_rows_;  ///< sqrt(k) H in the axes of the supports
  Stage stage_ = Stage::proportional;
  double largest_load_ = 0.0;  ///< of the forces and moments of the unit load: imposed strains are none
  /// Scales of force of what the unit proportional and the constant actions impose, see imposed_force().
  double proportional_imposed_ = 0.0;
  double constant_imposed_ = 0.0;
};

}  // namespace snapthrough
