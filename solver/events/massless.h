#pragma once
/// @file
/// Loss of stability of the freedoms that have no mass, under loads without a potential.

#include <optional>

#include "solver/discrete/mass_matrix.h"
#include "solver/events/critical_event.h"
#include "solver/path/point_solver.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// Whether some element has no mass.
[[nodiscard]] bool has_massless_elements(const MassMatrix& masses);

/// @brief Whether a load without a potential acts where the structure has no mass: then small masses there,
/// which the model leaves out, may flutter at a lower load.
[[nodiscard]] bool follows_without_mass(const Structure& structure, const MassMatrix& masses);

/// @brief Looks for loads at which a natural frequency becomes infinite.
///
/// With the freedoms 0 without mass and m with mass, motions of the masses have the stiffness
/// S = J_mm - J_m0 J_00^-1 J_0m. Beside flutter of S and det J = 0, stability is lost where det J_00 = 0: an
/// eigenvalue omega^2 leaves through infinity and returns from minus infinity, although no motion has a real
/// eigenvalue zero. For large sigma, det(J + sigma M) has the sign of det J_00; its zero is off by the
/// eigenvalues of S over sigma. With a symmetric J the tangent is indefinite before.
class MasslessSearch {
 public:
  /// @param structure, masses kept by reference; must outlive this object
  MasslessSearch(const Structure& structure, const MassMatrix& masses, StructuralProblem::Stage stage);

  /// @brief The first load of a step at which J_00 is singular.
  /// @param largest eigenvalue omega^2 of the step's beginning
  /// @param tolerance on the load, relative
  [[nodiscard]] std::optional<CriticalEvent> on_step(PointSolver& solver, const PathPoint& from,
                                                     const PathPoint& to, double largest, double tolerance);

 private:
  [[nodiscard]] double determinant(const PathPoint& point);
  [[nodiscard]] std::optional<CriticalEvent> locate(PointSolver& solver, const PathPoint& from,
                                                    double value_from, const PathPoint& to, double value_to,
                                                    double tolerance);

  const Structure& structure_;
  const MassMatrix& masses_;
  StructuralProblem problem_;
  double sigma_ = 0.0;      ///< 0: not chosen yet
  double log_scale_ = 0.0;  ///< log of the unit of determinants
};

}  // namespace snapthrough
