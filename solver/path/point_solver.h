#pragma once
/// @file
/// Corrects points of a path and factorises the tangent stiffness there.

#include <Eigen/Core>
#include <optional>

#include "solver/newton/contact_state.h"
#include "solver/newton/corrector.h"
#include "solver/path/path_norm.h"
#include "solver/path/path_point.h"

namespace snapthrough {

/// Response to a unit load with the factors of one tangent stiffness, and what these tell.
struct LoadResponse {
  Eigen::VectorXd rate;  ///< J^-1 load: change of y by a unit of the load factor
  TangentReport tangent;
};

/// @brief Corrects points of one problem's path, in one norm, and counts the work.
///
/// In path/ and trace/ this class alone linearises the problem, solves with its factors and sets its holds:
/// each function that takes a point sets the holds of that point. The factors are those of the last
/// correction until the next call.
class PointSolver {
 public:
  /// @param problem kept by reference
  PointSolver(EquilibriumProblem& problem, CorrectorOptions options);

  [[nodiscard]] EquilibriumProblem& problem() const { return problem_; }
  [[nodiscard]] PathNorm& norm() { return norm_; }
  [[nodiscard]] const PathNorm& norm() const { return norm_; }
  [[nodiscard]] const CorrectorOptions& options() const { return options_; }
  [[nodiscard]] PathStatistics& statistics() { return statistics_; }
  [[nodiscard]] const PathStatistics& statistics() const { return statistics_; }

  /// @brief Response to a unit load at a point, with its holds.
  /// @return empty when the tangent stiffness is singular: the response exceeds kSingularResponse
  [[nodiscard]] std::optional<LoadResponse> response_at(const PathPoint& point, Regime::Contact contact);
  /// @brief Sets the tangent of a point, of norm one, from a response there, and the inertia.
  /// @param sign 1 or -1: sense of the load factor along the tangent
  void set_tangent(PathPoint& point, const LoadResponse& response, double sign);
  /// @brief Sets the tangent of a corrected point in the sense of a direction, and the inertia.
  /// @param outcome of the correction that ended at the point
  /// @param before negative eigenvalues of a neighbouring point
  void set_tangent(PathPoint& point, const CorrectorOutcome& outcome, int before,
                   const Eigen::VectorXd& direction, double direction_lambda);

  /// @brief Corrects a point in the plane through it that is normal to a direction.
  /// @param scale norm of the step or the distance that led to the point
  [[nodiscard]] CorrectorOutcome correct_in_plane(const Eigen::VectorXd& normal, double normal_lambda,
                                                  double scale, const CorrectorOptions& options,
                                                  PathPoint& point);
  /// @brief Corrects a point at its load, as far as rounding allows.
  /// @return whether that converged; else the point is what the last correction left
  [[nodiscard]] bool correct_at_load(double scale, PathPoint& point);
  /// @brief Corrects a point at its load; each correction is shortened to where it lowers the energy most.
  [[nodiscard]] CorrectorOutcome correct_by_least_energy(double scale, int iterations, PathPoint& point);
  /// @brief Equilibrium at a load of a structure that only tension stiffens, by least energy: each state is
  /// that of least energy with rods that resist to displacements from the state before (the proximal point
  /// algorithm: Rockafellar, SIAM J. Control Optim. 14, 1976), less and less.
  /// @param y a state to begin with; the equilibrium where there is one
  /// @return whether a stable equilibrium was found; a part of the structure may hang on slack members there
  [[nodiscard]] bool find_tight_state(double lambda, Eigen::VectorXd& y);
  /// @brief A motion that the last factors do not resist; empty: there is none.
  [[nodiscard]] Eigen::VectorXd unresisted_motion();
  /// @brief Equilibrium at a load when nothing is known of the contact, see find_contact_state().
  /// @param holds of the wanted state
  [[nodiscard]] std::optional<ContactState> contact_state(double lambda, const SharedHolds& holds,
                                                          const Eigen::VectorXd* guess,
                                                          bool small_displacements = false);

  /// @brief A motion that the last factors do not resist although the structure with bilateral supports
  /// would: a part that one-sided supports touch without pressure, or not at all.
  /// @return empty: every part is held. The factors are lost.
  [[nodiscard]] Eigen::VectorXd free_motion();
  /// @brief Negative eigenvalues at a point, which is factorised.
  [[nodiscard]] int negative_at(const PathPoint& point);
  /// @brief Finds the softest motions at a point and their rates of stiffness along the path.
  /// @pre the problem was factorised last at the point, or so near that it makes no difference
  /// @param start modes of a neighbouring point; null: none are known
  void find_modes(PathPoint& point, const SharedModes& start);
  /// @brief Finds the softest motions at the first point of a path; the problem is factorised just beyond it.
  /// On one-sided supports the rates stay empty, because contact changes within the first step.
  void find_first_modes(PathPoint& start);

 private:
  /// Corrects a point under a side condition and counts the work.
  [[nodiscard]] CorrectorOutcome correct_with(const SideCondition& side, double scale,
                                              const CorrectorOptions& options, PathPoint& point);

  EquilibriumProblem& problem_;
  CorrectorOptions options_;
  PathNorm norm_;
  PathStatistics statistics_;
  bool symmetric_ = true;  ///< the tangent stiffness is symmetric: stiffnesses of motions are real
  Workspace work_;
  SideCondition side_;
};

/// @brief Corrects a point to rounding where the corrector stopped once its tangent was accurate enough: near
/// a singular point the inertia of such a point may be that of the other side.
/// @param from the point before it on the path
void recorrect_to_rounding(PointSolver& solver, const PathPoint& from, PathPoint& point);

/// @brief Negative eigenvalues next to a point that has `before` of them. Where the tangent stiffness is not
/// symmetric a real eigenvalue passes zero where the determinant changes its sign; the symmetric part, whose
/// eigenvalues the report counts, tells only in which sense.
[[nodiscard]] int count_next_to(int before, const TangentReport& report);

}  // namespace snapthrough
