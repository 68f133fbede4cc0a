#pragma once
/// @file
/// The equilibrium problem of a structure on a mesh.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "solver/discrete/coupled_solution.h"
#include "solver/discrete/structure.h"
#include "solver/member/chain.h"
#include "solver/numeric/symmetric_indefinite.h"
#include "solver/problem/equilibrium_problem.h"
#include "solver/problem/node_spring_work.h"

namespace snapthrough {

/// @brief Mixed equilibrium equations of a Structure, factorised at three levels.
///
/// Level 1 eliminates element interiors (ElementSet), level 2 the nodes inside members (Chain). Level 3 is a
/// sparse symmetric system for nodal displacements, released rotations and member end forces, with one block
/// per member:
///
///   [ K_s + springs   X^T   .  ] [u_nodes]
///   [ X               -F    I  ] [m_member]     (I acts on its end node)
///
/// with a block also for each part of a member between nodes at which stops act, and for each stop of a row g
///
///   [ .   g  ] [u_node]
///   [ g^T -c ] [force ]      (see problem/node_spring_work.h)
///
/// Couplings between elements are added to its solutions (CoupledSolution). Holds k H H^T add a block with
/// one unknown force per motion: [ . sqrt(k) H ; . -1 ].
///
/// Rows of a node with an inclined support are in the support's axes. The row of a constrained component is u
/// - lambda d - d_0. The negative eigenvalues of the constrained displacement stiffness number the negative
/// pivots of all levels minus one for each stress and multiplier (Haynsworth's inertia formula).
///
/// residual(), linearise() and tangent_products() throw Cancelled when the structure's stop token is set.
class StructuralProblem final : public EquilibriumProblem {
 public:
  /// @param structure kept by reference; must outlive this object
  explicit StructuralProblem(const Structure& structure);

  [[nodiscard]] Eigen::Index size() const override { return structure_.size; }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return structure_.metric; }
  void load(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& out) override;
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override;
  [[nodiscard]] double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd& y,
                                         double lambda) override;
  [[nodiscard]] double residual_rounding(const Eigen::VectorXd& y, double lambda) const override;

  [[nodiscard]] bool one_sided() const override { return structure_.one_sided; }
  [[nodiscard]] bool may_kink() const override { return structure_.one_sided || !structure_.curves.empty(); }
  [[nodiscard]] MovingZones moving_zones(const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& rate) const override;
  [[nodiscard]] double missed_contact(const FrozenContact& frozen, const Eigen::VectorXd& y) const override;
  [[nodiscard]] FrozenContact freeze(const MovingZones& zones, const Eigen::VectorXd& y) const override;
  [[nodiscard]] const Eigen::MatrixXd& free_motions() const override { return structure_.free_motions; }
  void set_holds(const SharedHolds& holds) override;
  [[nodiscard]] Eigen::MatrixXd tangent_change(const Eigen::VectorXd& y, double lambda,
                                               const PathDirection& along,
                                               const Eigen::Ref<const Eigen::MatrixXd>& motions) override;
  [[nodiscard]] Eigen::VectorXd load_change(const Eigen::VectorXd& y, double lambda,
                                            const PathDirection& along) override;
  void force_along(const Eigen::VectorXd& motion, Eigen::VectorXd& out) const override;
  /// Euler load factor of the member that buckles first: min over members of pi^2 EI / (N l^2).
  [[nodiscard]] double critical_load_scale(const Eigen::VectorXd& unit_response) const override;
  [[nodiscard]] double largest_critical_load_scale(const Eigen::VectorXd& unit_response) const override;
  /// @brief Largest section force of the response to a unit load of the current stage that counts as
  /// rounding. Zero where no action imposes strains or displacements.
  [[nodiscard]] double least_force() const;

  /// Actions that the load factor multiplies: proportional ones, with the constant ones in full; or constant
  /// ones.
  enum class Stage { proportional, constant };
  void set_stage(Stage stage) { stage_ = stage; }
  void metric_forces(const Eigen::Ref<const Eigen::VectorXd>& x,
                     Eigen::Ref<Eigen::VectorXd> out) const override;
  [[nodiscard]] Eigen::VectorXd imposed_motion(const Eigen::VectorXd& rows) const override;
  [[nodiscard]] double work(const Eigen::Ref<const Eigen::VectorXd>& forces,
                            const Eigen::Ref<const Eigen::VectorXd>& motion) const override;
  /// @brief Contact state at y: one-sided supports act where they touch, and are absent elsewhere.
  /// @param small_displacements rods change their lengths by the linear part of the displacements
  [[nodiscard]] FrozenContact frozen_contact(const Eigen::VectorXd& y,
                                             bool small_displacements = false) const;
  /// @brief Marks the one-sided supports that touch without pressure at y: distance below 1e-9 of the largest
  /// displacement, force below 1e-6 of the largest force; foundations on their whole part of an element.
  [[nodiscard]] TouchingMarks marks_at(const Eigen::VectorXd& y, bool small_displacements = false) const;
  /// @brief Displacement of `mode` into the medium at each marked spring; `out` is overwritten.
  void touching_displacements(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                              std::vector<double>& out) const;
  /// @brief Sets which marked supports act: springs as given, foundations where `mode` moves into the medium.
  /// @param mode empty: marked foundations act everywhere
  /// @param springs one entry per marked spring
  void set_touching(const TouchingMarks& marks, const Eigen::VectorXd& mode, std::span<const char> springs,
                    FrozenContact& out) const;
  /// Marked supports with the contact of set_touching(). @param frozen null: no marked support acts
  [[nodiscard]] TouchingSupports touching(const TouchingMarks& marks, const FrozenContact* frozen) const;
  [[nodiscard]] std::size_t touching_springs(const TouchingMarks& marks) const;
  /// @brief Turns forces in global axes to the row order of linearise(), zero in constrained rows.
  void to_rows(Eigen::Ref<Eigen::MatrixXd> forces) const {
    for (Eigen::Index i = 0; i < forces.cols(); ++i) release_rows(forces.col(i));
  }
  /// @brief Whether solve() is with the transpose of the tangent, from the next linearise() on.
  void set_transposed(bool transposed) { follower_loads_.transpose(transposed); }

 protected:
  /// Uses small displacements where the regime or the structure asks for them.
  void find_residual(const Eigen::VectorXd& y, double lambda, const Regime& asked,
                     Eigen::VectorXd& f) override;
  TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& asked,
                          Eigen::VectorXd& f) override;
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double lambda, const Regime& asked,
                                              const Eigen::Ref<const Eigen::MatrixXd>& directions) override;

 private:
  [[nodiscard]] double largest_axial_force(std::size_t member, const Eigen::VectorXd& response) const;
  /// x := S^-1 x with the symmetric part S of the tangent.
  void solve_symmetric(Eigen::Ref<Eigen::MatrixXd> x);
  /// Likewise, without the couplings between elements.
  void solve_uncoupled(Eigen::Ref<Eigen::MatrixXd> x);
  void add_couplings(TangentReport& report);
  void reduce_part(std::size_t part, const ColumnLanes& lanes, Eigen::Index count);
  void solve_nodes(Eigen::Ref<Eigen::VectorXd> rhs, Eigen::Ref<Eigen::VectorXd> reduced);
  void recover_part(std::size_t part, const ColumnLanes& lanes, Eigen::Ref<Eigen::MatrixXd> x) const;
  void turn_from_supports(Eigen::Ref<Eigen::VectorXd> x) const;
  void add_follower_loads(const Eigen::VectorXd& y, double lambda, TangentReport& report);
  /// Factors on the proportional and the constant actions at a load factor.
  [[nodiscard]] LoadFactors factors(double lambda) const {
    return stage_ == Stage::proportional ? LoadFactors{lambda, 1.0} : LoadFactors{0.0, lambda};
  }
  /// Derivative of factors() by the load factor.
  [[nodiscard]] LoadFactors factor_rates() const {
    return stage_ == Stage::proportional ? LoadFactors{1.0, 0.0} : LoadFactors{0.0, 1.0};
  }
  /// Sets the constrained rows to zero and turns the others to the axes of the supports.
  void release_rows(Eigen::Ref<Eigen::VectorXd> f) const;
  [[nodiscard]] Regime regime_of(const Regime& asked) const;
  [[nodiscard]] TouchingDistance touching_distance(const Eigen::VectorXd& y) const;
  void start_residual(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                      Eigen::VectorXd& f) const;
  void turn_to_supports(Eigen::Ref<Eigen::VectorXd> f) const;
  void add_node_products(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                         const Eigen::Ref<const Eigen::VectorXd>& direction,
                         Eigen::Ref<Eigen::VectorXd> out) const;
  [[nodiscard]] double displacement(const NodeSpring& spring, const Eigen::VectorXd& y,
                                    bool small_displacements) const;
  void fill_spring(std::size_t spring, Eigen::MatrixXd& block) const;
  void add_node_springs(const Eigen::VectorXd& y, const Regime& regime, Eigen::VectorXd& f);
  void add_holds(const Eigen::VectorXd& y, Eigen::VectorXd& f) const;
  /// Largest residual among the rows of forces and moments; the other rows are displacements and strains.
  [[nodiscard]] double force_norm(const Eigen::VectorXd& f) const;
  [[nodiscard]] double largest_load(const LoadFactors& factors);
  [[nodiscard]] double largest_force(const Eigen::VectorXd& y, double lambda) const;
  [[nodiscard]] double imposed_force(double lambda) const;
  [[nodiscard]] double force_scale(const Eigen::VectorXd& y, double lambda) const;
  void constrain_residual(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& f) const;
  void plan_nodes();
  void assemble_nodes();
  void fill_part(std::size_t part, Eigen::MatrixXd& block) const;
  /// Moves the constrained displacements to the right-hand side.
  void subtract_fixed(const Eigen::Ref<const Eigen::VectorXd>& rhs,
                      Eigen::Ref<Eigen::VectorXd> reduced) const;
  void subtract_ground(Eigen::Ref<Eigen::MatrixXd> x) const;
  /// First row of the end forces of a part of a member between nodes, in the node system; displacements and
  /// forces of stops keep their index.
  [[nodiscard]] Eigen::Index multiplier(std::size_t part) const {
    return structure_.before_elements() + 3 * static_cast<Eigen::Index>(part);
  }
  /// First element of a part of a member between nodes.
  [[nodiscard]] int first_of(std::size_t part) const { return structure_.parts_between_nodes[part]; }
  [[nodiscard]] std::array<double, 2> turn_of(int dof) const;
  [[nodiscard]] Eigen::Matrix3d axes_of(const std::array<int, 3>& dofs) const;
  [[nodiscard]] bool is_fixed(Eigen::Index scalar) const;

  const Structure& structure_;
  std::stop_token stop_;
  std::size_t parts_;  ///< number of parts of members between nodes
  std::vector<CondensedElement> condensed_;
  std::vector<CondensedForces> condensed_forces_;
  std::vector<std::array<double, 2>> turns_;  ///< cosine and sine of the support angle at each node
  std::vector<int> inclined_;                 ///< nodes with an inclined support
  std::vector<Chain> chains_;                 ///< one per part of a member between nodes
  std::vector<Eigen::Index> free_;            ///< rows of the node system that are unknown
  std::vector<Eigen::Index> fixed_;
  std::vector<std::vector<int>> node_rows_;   ///< rows of each block of the node system
  std::vector<Eigen::MatrixXd> node_blocks_;  ///< blocks of members, node springs and held nodes
  std::vector<char> free_rotation_;  ///< node rotations without stiffness: all members are released there
  bool corrected_ = false;           ///< solve() adds the nonsymmetric part of follower loads
  bool planned_ = false;             ///< node_rows_ and factor_ include the holds
  SymmetricIndefinite factor_;
  Eigen::MatrixXd node_rhs_, free_rhs_;  ///< scratch of solve()
  CoupledSolution couplings_;
  FollowerLoads follower_loads_;
  std::unique_ptr<ElementWork> elements_;
  NodeSpringWork springs_;
  SharedHolds holds_;
  Eigen::MatrixXd hold_rows_;  ///< sqrt(k) H in the support axes
  Stage stage_ = Stage::proportional;
  /// Largest force or moment of the unit proportional and of the constant loads, without imposed strains.
  double proportional_force_ = 0.0;
  double constant_force_ = 0.0;
  /// Force scales of the unit proportional and of the constant imposed strains, see imposed_force().
  double proportional_imposed_ = 0.0;
  double constant_imposed_ = 0.0;
};

}  // namespace snapthrough
