#pragma once
/// @file
/// Tangent stiffness of the linearised buckling analysis as a function of the load factor.

#include <Eigen/Core>

#include "solver/events/buckling.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// @brief The pencil J(lambda) = J_0 + lambda G in the mixed unknowns at zero displacements and stresses s_c
/// + lambda s_p (constant and proportional actions). For LoadSense::reversed, lambda multiplies the opposite
/// of the proportional actions.
class BucklingPencil {
 public:
  BucklingPencil(const Structure& structure, StructuralProblem& problem, LoadSense sense)
      : structure_(structure), problem_(problem), sense_(sense == LoadSense::reversed ? -1.0 : 1.0) {}

  /// Computes the linear stresses of both kinds of actions, with the contact and the tangents of laws under
  /// the reference load. Returns false when no equilibrium with small displacements was found under that
  /// load.
  [[nodiscard]] bool set_prestress(double reference);
  [[nodiscard]] int count(double lambda);
  void solve(Eigen::VectorXd& x) { problem_.solve(x); }
  [[nodiscard]] Eigen::VectorXd geometric(const Eigen::VectorXd& x);
  [[nodiscard]] Eigen::VectorXd product(double lambda, const Eigen::VectorXd& x) {
    return problem_.tangent_product(stress(lambda), sense_ * lambda, x, regime_at(lambda));
  }
  /// Rayleigh quotient of a motion, evaluated with the tangent and not with its factors.
  [[nodiscard]] double quotient(const Eigen::VectorXd& x) {
    return -x.dot(product(0.0, x)) / x.dot(geometric(x));
  }
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
  /// regime() with the forces of rods in the linear prestress at a load factor; valid until the next call.
  [[nodiscard]] Regime regime_at(double lambda);
  [[nodiscard]] Eigen::VectorXd linear_response(StructuralProblem::Stage stage, double lambda, Regime regime);
  void drop_rounding(double least, Eigen::VectorXd& response) const;
  [[nodiscard]] bool freeze_contact(double reference);

  const Structure& structure_;
  StructuralProblem& problem_;
  double sense_;  ///< sign of the problem's load factor for positive lambda
  Eigen::VectorXd constant_;
  Eigen::VectorXd proportional_;
  Eigen::VectorXd prestress_;  ///< linear response of regime_at()
  SharedHolds holds_;          ///< motions without stiffness, held by artificial springs
  TouchingMarks marks_;
  FrozenContact contact_;
  int factorizations_ = 0;
};

}  // namespace snapthrough
