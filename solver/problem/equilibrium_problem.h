#pragma once
/// @file
/// Interface between the structural model and path following.

#include <Eigen/Core>

#include "solver/model/model_traits.h"
#include "solver/problem/point_context.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// Inertia and determinant of a factorised tangent stiffness.
struct TangentReport {
  int negative = 0;          ///< negative eigenvalues of the constrained tangent stiffness
  double log_abs_det = 0.0;  ///< log |det J|, up to an additive constant of the problem
  /// true: the tangent is not symmetric, and only the parity of `negative` is certain (sign of the
  /// determinant)
  bool parity_only = false;
};

/// A direction in (y, lambda), of any length.
struct PathDirection {
  const Eigen::VectorXd& y;
  double lambda = 0.0;
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
  /// @brief Diagonal weights of the path's norm: >= 0, dimensionless, independent of the mesh, zero for
  /// unknowns that are not displacements.
  [[nodiscard]] virtual const Eigen::VectorXd& metric() const = 0;
  /// @brief Computes the residual F(y, lambda) into `f` (overwritten).
  void residual(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& f, const Regime& regime = {}) {
    find_residual(y, lambda, regime, f);
  }
  /// @brief Computes F(y, lambda) into `f` and factorises J(y, lambda) for solve().
  TangentReport linearise(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& f,
                          const Regime& regime = {}) {
    return factorise(y, lambda, regime, f);
  }
  /// @brief Computes the reference load -dF/dlambda at (y, lambda) into `out` (overwritten).
  virtual void load(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& out) = 0;
  /// @brief x := J^-1 x with the factors of the last linearise(). A block of columns costs less than each
  /// alone.
  virtual void solve(Eigen::Ref<Eigen::MatrixXd> x) = 0;
  /// Kind of the equations. Where a support is one-sided, the response need not be differentiable at zero
  /// load.
  [[nodiscard]] virtual const ModelTraits& traits() const;
  /// @brief Contact zones of one-sided foundations at y; their ends move as y changes at `rate`.
  [[nodiscard]] virtual MovingZones moving_zones(const Eigen::VectorXd&, const Eigen::VectorXd&) const {
    return {};
  }
  /// @brief Contact state in which foundations act on the given zones, and springs where they act at y.
  [[nodiscard]] virtual FrozenContact freeze(const MovingZones&, const Eigen::VectorXd&) const { return {}; }
  /// @brief Length, in elements, on which foundation contact at y differs noticeably from `frozen`.
  [[nodiscard]] virtual double missed_contact(const FrozenContact&, const Eigen::VectorXd&) const {
    return 0.0;
  }
  /// @brief Rigid-body motions that only one-sided supports can resist: orthonormal columns over the leading
  /// unknowns; no columns when there are none.
  [[nodiscard]] virtual const Eigen::MatrixXd& free_motions() const;
  /// @brief Adds the artificial springs of `holds` to F and J from now on; null removes them.
  virtual void set_holds(const SharedHolds&) {}
  /// @brief Takes supports as a history left them from now on; null: as nothing left them yet.
  virtual void set_history(const SharedHistory&) {}
  /// @brief History after the equilibrium (y, lambda) is reached from the present one. The forces at y are
  /// the same with both.
  [[nodiscard]] virtual SharedHistory remembered(const Eigen::VectorXd&, double) { return nullptr; }
  void set_context(const PointContext& context) {
    set_holds(context.holds);
    set_history(context.history);
  }
  /// @brief Right-hand side of solve() for unit forces along a motion of the leading unknowns (overwritten).
  virtual void force_along(const Eigen::VectorXd& motion, Eigen::VectorXd& out) const {
    out.setZero(size());
    out.head(motion.size()) = motion;
  }
  /// @brief J(y, lambda) times each column of `motions`, in the row order of linearise(); keeps the factors.
  [[nodiscard]] Eigen::MatrixXd tangent_products(const Eigen::VectorXd& y, double lambda,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                                 const Regime& regime = {}) {
    return find_products(y, lambda, regime, motions);
  }
  [[nodiscard]] Eigen::VectorXd tangent_product(const Eigen::VectorXd& y, double lambda,
                                                const Eigen::VectorXd& motion, const Regime& regime = {}) {
    return tangent_products(y, lambda, motion, regime);
  }
  /// @brief d/de J(y + e a, lambda + e da) b at e = 0 along a direction (a, da), for each column b of
  /// `motions`; keeps the factors. Central differences here, exact in StructuralProblem.
  [[nodiscard]] virtual Eigen::MatrixXd tangent_change(const Eigen::VectorXd& y, double lambda,
                                                       const PathDirection& along,
                                                       const Eigen::Ref<const Eigen::MatrixXd>& motions);
  /// @brief d/de load(y + e a, lambda + e da) at e = 0, likewise.
  [[nodiscard]] virtual Eigen::VectorXd load_change(const Eigen::VectorXd& y, double lambda,
                                                    const PathDirection& along);
  /// @brief Right-hand side of solve() for the forces W x (W: metric), zero in constrained rows.
  /// @param out overwritten; as long as x
  virtual void metric_forces(const Eigen::Ref<const Eigen::VectorXd>& x,
                             Eigen::Ref<Eigen::VectorXd> out) const {
    out = metric().cwiseProduct(x);
  }
  /// @brief Extends the prescribed displacements in the constrained rows of `rows` by zeros.
  [[nodiscard]] virtual Eigen::VectorXd imposed_motion(const Eigen::VectorXd& rows) const {
    return Eigen::VectorXd::Zero(rows.size());
  }
  /// @brief Work of forces (row order of linearise()) on a motion that keeps constrained displacements fixed.
  [[nodiscard]] virtual double work(const Eigen::Ref<const Eigen::VectorXd>& forces,
                                    const Eigen::Ref<const Eigen::VectorXd>& motion) const {
    return forces.dot(motion);
  }
  /// @brief Estimated first critical load factor from the response to a unit load; infinity without axial
  /// force.
  [[nodiscard]] virtual double critical_load_scale(const Eigen::VectorXd& unit_response) const;
  /// @brief Estimated load factor at which the last member buckles; 0 when the response has no axial force.
  [[nodiscard]] virtual double largest_critical_load_scale(const Eigen::VectorXd&) const { return 0.0; }
  /// @brief Norm of the residual f over the forces and displacements that it balances; rounding gives 1e-15.
  [[nodiscard]] virtual double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd& y,
                                                 double lambda) = 0;
  /// @brief Relative residual at y by rounding in the forces of stiff supports; 0 without such supports.
  /// @pre residual() or linearise() was last called at y
  [[nodiscard]] virtual double residual_rounding(const Eigen::VectorXd&, double) const { return 0.0; }

 protected:
  /// Implementations of residual(), linearise() and tangent_products().
  virtual void find_residual(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                             Eigen::VectorXd& f) = 0;
  virtual TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                                  Eigen::VectorXd& f) = 0;
  [[nodiscard]] virtual Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double lambda,
                                                      const Regime& regime,
                                                      const Eigen::Ref<const Eigen::MatrixXd>& motions) = 0;
};

}  // namespace snapthrough
