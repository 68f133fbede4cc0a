#pragma once
/// @file
/// Null vector of the tangent stiffness at a critical point.

#include <Eigen/Core>

#include "solver/events/critical_event.h"
#include "solver/path/path_point.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief Eigenvector of the tangent stiffness for the eigenvalue nearest to zero, by inverse iteration in
/// the problem's metric; its norm is one.
/// @param start initial vector, not orthogonal to the result
/// @post the problem is factorised at the point
[[nodiscard]] Eigen::VectorXd null_vector(EquilibriumProblem& problem, const PathPoint& point,
                                          Eigen::VectorXd start);

/// @brief Mode of a critical point: null vector of its tangent stiffness; at a limit point the path's
/// direction.
///
/// Where contact changes the stiffness abruptly, no eigenvalue is zero; the mode is then the path's tangent
/// at a limit point and the softest motion at a bifurcation. At a multiple point it is one of several modes.
/// @param event critical point of `problem`; its point may be interpolated
/// @return all unknowns, scaled, of no particular sign
[[nodiscard]] Eigen::VectorXd mode_of(EquilibriumProblem& problem, const CriticalEvent& event);

}  // namespace snapthrough
