#pragma once
/// @file
/// The equilibrium problem of a structure on a mesh.

#include <Eigen/Core>
#include <memory>
#include <stop_token>
#include <vector>

#include "solver/discrete/coupled_solution.h"
#include "solver/discrete/structure.h"
#include "solver/problem/contact_questions.h"
#include "solver/problem/equilibrium_problem.h"
#include "solver/problem/force_scales.h"
#include "solver/problem/joint_work.h"
#include "solver/problem/node_spring_work.h"
#include "solver/problem/node_system.h"
#include "solver/problem/support_axes.h"

namespace snapthrough {

/// @brief Mixed equilibrium equations of a Structure, factorised at three levels.
///
/// Level 1 eliminates element interiors (ElementSet), levels 2 and 3 the nodes inside members and those of
/// the model (NodeSystem). Couplings between elements (CoupledSolution) and loads that follow (FollowerLoads)
/// are added to its solutions.
///
/// Rows of a node with an inclined support are in the support's axes (SupportAxes). The row of a constrained
/// component is u - lambda d - d_0.
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
                                         double lambda) override {
    return scales_.relative(f, y, factors(lambda));
  }
  [[nodiscard]] double residual_rounding(const Eigen::VectorXd& y, double lambda) const override;

  [[nodiscard]] const ModelTraits& traits() const override { return structure_.traits; }
  [[nodiscard]] MovingZones moving_zones(const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& rate) const override {
    return structure_.elements->contacts().moving_zones(y, rate);
  }
  [[nodiscard]] double missed_contact(const FrozenContact& frozen, const Eigen::VectorXd& y) const override {
    return structure_.elements->contacts().missed(frozen, y);
  }
  [[nodiscard]] FrozenContact freeze(const MovingZones& zones, const Eigen::VectorXd& y) const override {
    return contact().frozen(zones, y);
  }
  [[nodiscard]] const Eigen::MatrixXd& free_motions() const override { return structure_.free_motions; }
  void set_holds(const SharedHolds& holds) override;
  [[nodiscard]] Eigen::MatrixXd tangent_change(const Eigen::VectorXd& y, double lambda,
                                               const PathDirection& along,
                                               const Eigen::Ref<const Eigen::MatrixXd>& motions) override;
  [[nodiscard]] Eigen::VectorXd load_change(const Eigen::VectorXd& y, double lambda,
                                            const PathDirection& along) override;
  void force_along(const Eigen::VectorXd& motion, Eigen::VectorXd& out) const override;
  [[nodiscard]] double critical_load_scale(const Eigen::VectorXd& unit_response) const override {
    return scales_.first_critical_load(unit_response, factor_rates());
  }
  [[nodiscard]] double largest_critical_load_scale(const Eigen::VectorXd& unit_response) const override {
    return scales_.last_critical_load(unit_response, factor_rates());
  }
  /// @brief Largest section force of the response to a unit load of the current stage that counts as
  /// rounding. Zero where no action imposes strains or displacements.
  [[nodiscard]] double least_force() const { return scales_.least(factor_rates()); }

  /// Actions that the load factor multiplies: proportional ones, with the constant ones in full; or constant
  /// ones.
  enum class Stage { proportional, constant };
  void set_stage(Stage stage) { stage_ = stage; }
  void metric_forces(const Eigen::Ref<const Eigen::VectorXd>& x,
                     Eigen::Ref<Eigen::VectorXd> out) const override;
  [[nodiscard]] Eigen::VectorXd imposed_motion(const Eigen::VectorXd& rows) const override {
    return axes_.imposed_motion(rows);
  }
  [[nodiscard]] double work(const Eigen::Ref<const Eigen::VectorXd>& forces,
                            const Eigen::Ref<const Eigen::VectorXd>& motion) const override {
    return axes_.work(forces, motion);
  }
  /// Contact of the structure in states of the current stage.
  [[nodiscard]] ContactQuestions contact() const { return {structure_, scales_, factors(0.0)}; }
  /// @brief Turns forces in global axes to the row order of linearise(), zero in constrained rows.
  void to_rows(Eigen::Ref<Eigen::MatrixXd> forces) const {
    for (Eigen::Index i = 0; i < forces.cols(); ++i) axes_.release(forces.col(i));
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
  /// x := S^-1 x with the symmetric part S of the tangent.
  void solve_symmetric(Eigen::Ref<Eigen::MatrixXd> x);
  /// Likewise, without the couplings between elements.
  void solve_uncoupled(const Eigen::Ref<Eigen::MatrixXd>& x);
  void add_couplings(TangentReport& report);
  void add_follower_loads(const Eigen::VectorXd& y, double lambda, TangentReport& report);
  /// Factors on the proportional and the constant actions at a load factor.
  [[nodiscard]] LoadFactors factors(double lambda) const {
    return stage_ == Stage::proportional ? LoadFactors{lambda, 1.0} : LoadFactors{0.0, lambda};
  }
  /// Derivative of factors() by the load factor.
  [[nodiscard]] LoadFactors factor_rates() const {
    return stage_ == Stage::proportional ? LoadFactors{1.0, 0.0} : LoadFactors{0.0, 1.0};
  }
  [[nodiscard]] Regime regime_of(const Regime& asked) const;
  void start_residual(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                      Eigen::VectorXd& f) const;
  void add_node_products(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                         const Eigen::Ref<const Eigen::VectorXd>& direction,
                         Eigen::Ref<Eigen::VectorXd> out) const;
  void add_node_springs(const Eigen::VectorXd& y, const Regime& regime, Eigen::VectorXd& f);
  void add_holds(const Eigen::VectorXd& y, Eigen::VectorXd& f) const;
  void constrain_residual(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& f) const;
  void subtract_ground(Eigen::Ref<Eigen::MatrixXd> x) const;

  const Structure& structure_;
  std::stop_token stop_;
  std::unique_ptr<ElementWork> elements_;
  NodeSpringWork springs_;
  JointWork joints_;
  SupportAxes axes_;
  ForceScales scales_;
  NodeSystem nodes_;
  CoupledSolution couplings_;
  FollowerLoads follower_loads_;
  std::vector<CondensedElement> condensed_;  ///< one per element
  SharedHolds holds_;
  Stage stage_ = Stage::proportional;
  bool corrected_ = false;  ///< solve() adds the nonsymmetric part of follower loads
};

}  // namespace snapthrough
