#pragma once
/// @file
/// Critical points of a structure with one parameter: points of a curve, solved by Newton's method.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "solver/newton/corrector.h"
#include "solver/result.h"
#include "solver/sweep/model_family.h"

namespace snapthrough {

/// A direction in (y, lambda, t): displacements, load factor, coordinate of the parameter.
struct LocusDirection {
  Eigen::VectorXd y;
  double lambda = 0.0;
  double t = 0.0;
};

/// @brief Norm of (dy, dlambda, dt): the path's norm, and the change of the coordinate over the range of its
/// values.
struct LocusMetric {
  PathMetric path;
  double parameter_weight = 1.0;  ///< 1 / span^2

  [[nodiscard]] double inner(const LocusDirection& a, const LocusDirection& b) const {
    return path.inner(a.y, a.lambda, b.y, b.lambda) + parameter_weight * a.t * b.t;
  }
};

/// A limit point or a bifurcation for one value of the parameter.
struct LocusPoint {
  bool bifurcation = false;
  double t = 0.0;  ///< coordinate of the parameter
  double lambda = 0.0;
  Eigen::VectorXd y;
  Eigen::VectorXd null;  ///< n: null motion, norm one in the metric W
  /// n.F''[n, n]: zero at a cusp of limit points. Its sign changes with that of n.
  double bend = 0.0;
  double load_work = 0.0;  ///< n.load: zero at a bifurcation. Its sign changes with that of n.
  double unfolding = 0.0;  ///< force along W n that restores an exact bifurcation; zero at limit points
  int others = 0;          ///< negative eigenvalues besides that of n
  /// Tangent of the curve, of norm one; empty where it was not asked for.
  LocusDirection direction;

  /// Type at a limit point: maximum or minimum of the load along the equilibrium path.
  [[nodiscard]] CriticalType type() const {
    if (bifurcation) return CriticalType::bifurcation;
    return bend * load_work < 0.0 ? CriticalType::limit_max : CriticalType::limit_min;
  }
};

/// Counts of the work on a curve.
struct LocusCounts {
  int factorizations = 0;
  int structures = 0;  ///< structures built
};

/// Which point of the curve is solved for.
enum class LocusSide {
  at_parameter,  ///< the coordinate of the guess
  in_plane       ///< the plane through the guess that is normal to its direction
};

/// Tolerances of the corrections; ratios without unit.
struct LocusOptions {
  double place = 1e-6;         ///< size of the next correction, in the locus norm
  double load = 1e-10;         ///< size of the next correction of the load, over the load
  double least_load = 0.0;     ///< load that `load` refers to where the load is smaller
  double reach = 0.1;          ///< largest distance from the guess, in the locus norm
  bool directions = true;      ///< whether the tangent of the curve is computed
  double imperfection = 1e-6;  ///< largest imperfection of a bifurcation that still counts as one
};

/// @brief Solves for critical points next to guesses by Newton's method.
///
/// Limit point: F = 0, J n = 0. Bifurcation (Moore): F + W n mu = 0, J n = 0, n.load = 0. Unknowns are y, n,
/// lambda, t, and mu. With the bordered solutions of [J, W n; n W, 0] for the residual (p), the load (q, with
/// n.load in the multiplier), the parameter (h) and the null motion (v) a correction is
/// dy = p + q dlambda + h dt + v alpha, where
///
///   [ A   B    P   ] [alpha  ]   [ -n.J n - n.F''[n, p] ]
///   [ -s  n.f  n.g ] [dlambda] = [ -n.r                 ]    (limit point; s = n.J n, f = load, g = -F_p)
///   [ B   C    R   ] [dt     ]   [ n.f - z.F''[n, p]    ]    (bifurcation, in its place; z = (q, 1))
///
/// and the third equation is the side condition. A = n.F''[n, n], B = n.F''[n, z], C = n.F''[z, z], P and R
/// the rates of n.J n and of -n.f with the parameter, by differences of two structures. Corrections after the
/// first use its factors and second derivatives while they converge fast.
class LocusSolver {
 public:
  /// @param family, metric, counts kept by reference
  LocusSolver(const ModelFamily& family, const LocusMetric& metric, LocusCounts& counts)
      : family_(family), metric_(metric), counts_(counts) {}

  /// @brief Solves with new factors.
  /// @param point guess with null motion and, for in_plane, direction; replaced by the solution
  /// @return false when the iteration diverges, leaves `reach`, or finds an imperfect bifurcation
  [[nodiscard]] bool solve(LocusSide side, const LocusOptions& options, LocusPoint& point);
  /// @brief Solves at the coordinate of the guess, begins with the factors of the last solve() and makes new
  /// ones where these converge slowly. The number of other negative eigenvalues, bend and direction are those
  /// of the guess while no new factors are made.
  [[nodiscard]] bool solve_with_last_factors(const LocusOptions& options, LocusPoint& point);
  /// @brief Member of the family at a coordinate, which the next solution there uses; null: see
  /// ModelFamily::at().
  [[nodiscard]] std::shared_ptr<FamilyMember> member_at(double t);
  /// @brief Stiffness m.J m of the softest motion m besides the null motion, norm one, at the last solution.
  /// @pre the last solve() was successful
  [[nodiscard]] double softest_other();

 private:
  struct Response {
    Eigen::VectorXd motion;
    double multiplier = 0.0;
  };
  [[nodiscard]] bool iterate(bool fresh);
  [[nodiscard]] bool factorise();
  [[nodiscard]] bool find_responses();
  void refresh();
  void differentiate();
  void find_parameter_rates();
  void differentiate_by_parameter();
  [[nodiscard]] Response bordered(double share, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  [[nodiscard]] Response response(const Eigen::VectorXd& forces) const;
  [[nodiscard]] std::array<Response, 2> responses(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::VectorXd forces_of_residual() const;
  [[nodiscard]] std::vector<std::pair<double, double>> stencil() const;
  [[nodiscard]] std::array<Eigen::RowVector3d, 2> equations() const;
  [[nodiscard]] LocusDirection part(int i) const;
  [[nodiscard]] std::array<double, 3> sizes() const;
  [[nodiscard]] bool step();
  [[nodiscard]] bool converged() const;
  void find_direction();
  [[nodiscard]] bool finish();
  [[nodiscard]] double work(const Eigen::VectorXd& forces, const Eigen::VectorXd& motion) const {
    return member_->problem.work(forces, motion);
  }

  const ModelFamily& family_;
  const LocusMetric& metric_;
  LocusCounts& counts_;
  LocusOptions options_;
  LocusPoint at_;
  LocusPoint guess_;
  bool in_plane_ = false;
  bool by_parameter_ = false;
  std::shared_ptr<FamilyMember> member_;    ///< structure at the coordinate of the point
  std::shared_ptr<FamilyMember> factored_;  ///< structure whose factors are used
  double member_t_ = 0.0;
  Eigen::VectorXd residual_, load_;
  // the motion n that borders the factors, W n as forces and as weights, the factors' solution v, and n.J n
  Eigen::VectorXd bordering_, metric_rows_, border_, solved_;
  double factored_stiffness_ = 0.0;
  int negative_ = 0;        ///< negative eigenvalues besides that of n
  Eigen::VectorXd v_;       ///< null motion of this correction
  double stiffness_ = 0.0;  ///< n.J n
  Response p_, q_, h_;
  Eigen::VectorXd rate_forces_;    ///< F_p
  Eigen::MatrixXd rate_products_;  ///< J_p [v, q]; the last column less load_p
  Eigen::VectorXd null_change_;    ///< F''[n] n
  Eigen::VectorXd load_change_;    ///< (dJ/dz) n
  double A_ = 0.0, B_ = 0.0, C_ = 0.0, P_ = 0.0, R_ = 0.0;
  double moved_ = 0.0;       ///< size of the last correction
  double moved_load_ = 0.0;  ///< that of the load
  double ratio_ = 1.0;       ///< ratio of the last two corrections
  double load_ratio_ = 1.0;  ///< ratio of the last two corrections of the load
};

}  // namespace snapthrough
