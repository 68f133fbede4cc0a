#pragma once
/// @file
/// Tangent stiffness of the linearised buckling analysis as a function of the load factor.

#include <Eigen/Core>
#include <optional>

#include "solver/events/eigenpairs.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// Sense of the proportional actions for which buckling loads are computed.
enum class LoadSense { as_given, reversed };

/// @brief The pencil J(lambda) = J_0 + lambda G in the mixed unknowns at zero displacements and stresses s_c
/// + lambda s_p (constant and proportional actions). For LoadSense::reversed, lambda multiplies the opposite
/// of the proportional actions.
///
/// Stresses enter the tangent in the rows of displacements alone. Solutions for forces on those therefore
/// satisfy the equations of section forces, and x^T J_0 x is twice the energy of their displacements.
class BucklingPencil final : public Pencil {
 public:
  BucklingPencil(const Structure& structure, StructuralProblem& problem, LoadSense sense)
      : structure_(structure), problem_(problem), sense_(sense == LoadSense::reversed ? -1.0 : 1.0) {}

  /// Computes the linear stresses of both kinds of actions, with the contact and the tangents of laws under
  /// the reference load. Laws with a curve: the stresses of the state under that load. Returns false when no
  /// equilibrium with small displacements was found under that load.
  [[nodiscard]] bool set_prestress(double reference);
  /// Factorises J(lambda). @return number of its negative eigenvalues
  int factorise(double lambda) override;
  /// J_0 x, or the product with the tangent without stresses where the start is unstable.
  [[nodiscard]] Eigen::MatrixXd weighted(const Eigen::MatrixXd& x) override;
  /// J(lambda)^-1 (J_0 - J(lambda)) x / lambda = -J(lambda)^-1 G x. @pre lambda > 0
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& x, const Eigen::MatrixXd& weighted) override;
  [[nodiscard]] Eigen::MatrixXd response(Eigen::MatrixXd forces) override;
  [[nodiscard]] Eigen::MatrixXd works(const Eigen::MatrixXd& x) override;
  [[nodiscard]] Eigen::Index size() const override { return problem_.size(); }
  /// J_0 is an inner product where the start is stable.
  [[nodiscard]] bool is_symmetric() const override { return is_stable_at_start_; }
  [[nodiscard]] bool is_searched_above() const override { return true; }
  /// G x of each column, in global axes.
  [[nodiscard]] Eigen::MatrixXd geometric(const Eigen::MatrixXd& x);
  void set_stable_at_start(bool is_stable) { is_stable_at_start_ = is_stable; }
  /// Rayleigh quotient of a motion, evaluated with the tangent and not with its factors.
  [[nodiscard]] double quotient(const Eigen::VectorXd& x);
  /// Section forces of the linear prestress at a load factor; other unknowns are zero.
  [[nodiscard]] Eigen::VectorXd stress(double lambda) const;
  [[nodiscard]] double scale() const { return problem_.critical_load_scale(proportional_); }
  [[nodiscard]] int factorizations() const { return factorizations_; }
  /// Whether the held motions have neither stiffness nor displacement at a load factor.
  [[nodiscard]] bool holds_are_idle(double lambda);
  [[nodiscard]] const SharedHolds& holds() const { return holds_; }
  [[nodiscard]] const TouchingMarks& marks() const { return marks_; }
  /// Contact in which the pencil is evaluated; changes apply to later calls.
  [[nodiscard]] FrozenContact& contact() { return contact_; }

 private:
  [[nodiscard]] Regime regime() const;
  /// Turns forces in the row order of the problem to global axes; those of constrained rows stay.
  void to_global(Eigen::MatrixXd& rows) const;
  /// regime() with the forces of rods in the linear prestress at a load factor; valid until the next call.
  [[nodiscard]] Regime regime_at(double lambda);
  [[nodiscard]] Eigen::VectorXd linear_response(StructuralProblem::Stage stage, double lambda, Regime regime);
  /// J(lambda) x of each column, in the row order of the problem.
  [[nodiscard]] Eigen::MatrixXd products(double lambda, const Eigen::MatrixXd& x) {
    return problem_.tangent_products(stress(lambda), sense_ * lambda, x, regime_at(lambda));
  }
  void drop_rounding(double least, Eigen::VectorXd& response) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> state_at(double load);
  [[nodiscard]] bool freeze_contact(double load);
  [[nodiscard]] bool set_curved_prestress(double load);

  const Structure& structure_;
  StructuralProblem& problem_;
  bool is_stable_at_start_ = true;
  double factorised_ = 0.0;  ///< load factor of the factors
  double sense_;             ///< sign of the problem's load factor for positive lambda
  Eigen::VectorXd constant_;
  Eigen::VectorXd proportional_;
  Eigen::VectorXd prestress_;  ///< linear response of regime_at()
  SharedHolds holds_;          ///< motions without stiffness, held by artificial springs
  TouchingMarks marks_;
  FrozenContact contact_;
  int factorizations_ = 0;
};

}  // namespace snapthrough
