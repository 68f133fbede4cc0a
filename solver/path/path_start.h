#pragma once
/// @file
/// The first point of a path.

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "solver/path/point_solver.h"

namespace snapthrough {

/// A first state that was refused because it lies too far from the unloaded structure: displacement gradients
/// (root mean square) there, and those of small displacements under the same load, which gaps and elastic
/// strains explain.
struct FarState {
  double gradient = 0.0;
  double small_displacement_gradient = 0.0;
};

/// The first point of a path, or why there is none.
struct PathStart {
  std::optional<PathPoint> point;
  /// Ratio of the first response with contact to that with all supports bilateral; large values mean that
  /// contact is held by rounding only.
  double contact_flexibility_ratio = 1.0;
  /// Without a point: a motion of a part that one-sided supports touch without pressure, or not at all;
  /// empty: there is none.
  Eigen::VectorXd free_motion;
  std::optional<FarState> far_state;  ///< without a point
  /// Share of the constant actions from which on vibrations about the structure grow and oscillate (flutter),
  /// if they do so at the point.
  std::optional<double> grows_from;

  explicit operator bool() const { return point.has_value(); }
};

/// @brief The first point of a path: y = 0 at lambda = 0, with the tangent towards growing load. Sets the
/// scales of the solver's norm.
///
/// Where supports act on one side only there is no derivative at zero load: the tangent is then that of the
/// contact under a very small load, which is solved from the structure with bilateral supports. The load is
/// lowered until the displacement is small. A structure that moves freely until a gap closes starts where it
/// comes to rest under that load.
/// @param direction 1: growing load; -1: falling load
/// @param largest_first_load load factor that the very small load must stay below
[[nodiscard]] PathStart find_start(PointSolver& solver, double direction = 1.0,
                                   double largest_first_load = std::numeric_limits<double>::infinity());

/// @brief The first point of a path at a known equilibrium under constant actions, at lambda = 0. Sets the
/// scales of the solver's norm.
/// @param y scaled unknowns; @param context of that state
[[nodiscard]] PathStart start_at_equilibrium(PointSolver& solver, const Eigen::VectorXd& y,
                                             double direction = 1.0, const PointContext& context = {});

/// @brief The first point of a path at the equilibrium next to given unknowns. Sets the scales of the
/// solver's norm.
/// @param y scaled unknowns near an equilibrium at the scaled load factor `lambda`
/// @return without a point when Newton's method finds no equilibrium there, or the tangent is singular
[[nodiscard]] PathStart start_near(PointSolver& solver, const Eigen::VectorXd& y, double lambda,
                                   double direction);

}  // namespace snapthrough
