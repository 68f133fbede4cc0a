#pragma once
/// @file
/// The seam between mechanics and path following.

#include <Eigen/Core>
#include <limits>

#include "solver/problem/holds.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// What a factorisation of the tangent says.
struct TangentReport {
  int negative = 0;          ///< negative eigenvalues of the constrained tangent stiffness
  double log_abs_det = 0.0;  ///< of the tangent, up to a constant of the problem
  /// The tangent is not symmetric: only whether `negative` is odd is certain, as the determinant's sign is.
  bool parity_only = false;
};

/// @brief F(y, lambda) = 0 with a symmetric tangent J = dF/dy.
///
/// Implementations keep the factors of the last linearise() for solve(). Not thread safe.
class EquilibriumProblem {
 public:
  EquilibriumProblem() = default;
  EquilibriumProblem(const EquilibriumProblem&) = delete;
  EquilibriumProblem& operator=(const EquilibriumProblem&) = delete;
  EquilibriumProblem(EquilibriumProblem&&) = delete;
  EquilibriumProblem& operator=(EquilibriumProblem&&) = delete;
  virtual ~EquilibriumProblem() = default;

  [[nodiscard]] virtual Eigen::Index size() const = 0;
  /// @brief Diagonal weights (>= 0) of the path's norm: mesh independent, dimensionless; zero for what is no
  /// displacement.
  [[nodiscard]] virtual const Eigen::VectorXd& metric() const = 0;
  /// @brief F(y, lambda); overwritten.
  void residual(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& f, const Regime& regime = {}) {
    find_residual(y, lambda, regime, f);
  }
  /// @brief F as residual(), and factorises J(y, lambda).
  TangentReport linearise(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& f,
                          const Regime& regime = {}) {
    return factorise(y, lambda, regime, f);
  }
  /// @brief -dF/dlambda at (y, lambda): the load by unit load factor.
  virtual void load(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& out) = 0;
  /// @brief x := J^-1 x with the last factorised J.
  virtual void solve(Eigen::VectorXd& x) = 0;
  /// Whether some support can act on one side only, so that the response need not be differentiable at zero
  /// load.
  [[nodiscard]] virtual bool one_sided() const { return false; }
  /// @brief Where one-sided foundations act at y, which moves at `rate` along a path.
  [[nodiscard]] virtual MovingZones moving_zones(const Eigen::VectorXd&, const Eigen::VectorXd&) const {
    return {};
  }
  /// @brief One-sided supports that act: foundations in these zones, springs where they do at y.
  [[nodiscard]] virtual FrozenContact freeze(const MovingZones&, const Eigen::VectorXd&) const { return {}; }
  /// @brief Elements on which foundations act at y and not in `frozen`, or the other way, so that it counts.
  [[nodiscard]] virtual double missed_contact(const FrozenContact&, const Eigen::VectorXd&) const {
    return 0.0;
  }
  /// @brief Motions that nothing but one-sided supports can resist: orthonormal columns over the first
  /// unknowns; without columns where there are none.
  [[nodiscard]] virtual const Eigen::MatrixXd& free_motions() const;
  /// @brief From now on these springs are part of F and J; empty: none.
  virtual void set_holds(const SharedHolds&) {}
  /// @brief Right-hand side of solve() for unit forces along a motion over the first unknowns; overwritten.
  virtual void force_along(const Eigen::VectorXd& motion, Eigen::VectorXd& out) const {
    out.setZero(size());
    out.head(motion.size()) = motion;
  }
  /// @brief J(y, lambda) times motions, column by column, in the rows of linearise(); the factors stay.
  [[nodiscard]] Eigen::MatrixXd tangent_products(const Eigen::VectorXd& y, double lambda,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                                 const Regime& regime = {}) {
    return find_products(y, lambda, regime, motions);
  }
  [[nodiscard]] Eigen::VectorXd tangent_product(const Eigen::VectorXd& y, double lambda,
                                                const Eigen::VectorXd& motion, const Regime& regime = {}) {
    return tangent_products(y, lambda, motion, regime);
  }
  /// @brief Right-hand side of solve() for the forces W x, W the metric: none on what is fixed; overwritten.
  virtual void metric_forces(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
    out = metric().cwiseProduct(x);
  }
  /// @brief The motion that has the displacements which stand in the rows of what is fixed, and no other.
  [[nodiscard]] virtual Eigen::VectorXd imposed_motion(const Eigen::VectorXd& rows) const {
    return Eigen::VectorXd::Zero(rows.size());
  }
  /// @brief Work of forces, in the rows of linearise(), on a motion that keeps what is fixed in place.
  [[nodiscard]] virtual double work(const Eigen::VectorXd& forces, const Eigen::VectorXd& motion) const {
    return forces.dot(motion);
  }
  /// @brief Rough size of the first critical load factor from the response to a unit load; infinity when it
  /// gives none.
  [[nodiscard]] virtual double critical_load_scale(const Eigen::VectorXd& unit_response) const;
  /// @brief Rough size of the load factor at which the member that buckles last does so; 0 when the response
  /// gives none.
  [[nodiscard]] virtual double largest_critical_load_scale(const Eigen::VectorXd&) const { return 0.0; }
  /// @brief Size of F relative to the forces and displacements that it balances; rounding gives about 1e-15.
  [[nodiscard]] virtual double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd& y,
                                                 double lambda) = 0;
  /// @brief Relative residual that the rounding of stiff supports' forces leaves at y, where residual() or
  /// linearise() was called last; corrections that gain no more need not get below.
  [[nodiscard]] virtual double residual_rounding(const Eigen::VectorXd&, double) const { return 0.0; }

 protected:
  /// What the functions of the same purpose above do.
  virtual void find_residual(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                             Eigen::VectorXd& f) = 0;
  virtual TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                                  Eigen::VectorXd& f) = 0;
  [[nodiscard]] virtual Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double lambda,
                                                      const Regime& regime,
                                                      const Eigen::Ref<const Eigen::MatrixXd>& motions) = 0;
};

inline const Eigen::MatrixXd& EquilibriumProblem::free_motions() const {
  static const Eigen::MatrixXd kNone;
  return kNone;
}

inline double EquilibriumProblem::critical_load_scale(const Eigen::VectorXd&) const {
  return std::numeric_limits<double>::infinity();
}

}  // namespace snapthrough
