#pragma once
/// @file
/// The motion that loses its stiffness at a critical point.

#include <Eigen/Core>

#include "solver/events/critical_event.h"
#include "solver/path/path_point.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief The eigenvector of the tangent stiffness whose eigenvalue is nearest to zero, by inverse iteration
/// in the problem's metric, in which its norm is one.
/// @param start of the iteration, not orthogonal to the result
/// @post the problem is factorised at the point
[[nodiscard]] Eigen::VectorXd null_vector(EquilibriumProblem& problem, const PathPoint& point,
                                          Eigen::VectorXd start);

/// @brief The mode of a critical point: the null vector of the tangent stiffness there. At a limit point that
/// is the path's direction.
///
/// Where contact changes the stiffness at once, no eigenvalue is zero: then it is the path's tangent at a
/// limit point, the softest motion at a bifurcation. At a point of higher multiplicity it is one of several.
/// @param event of that problem; its point may be interpolated
/// @return all unknowns, scaled, of no particular sign
[[nodiscard]] Eigen::VectorXd mode_of(EquilibriumProblem& problem, const CriticalEvent& event);

}  // namespace snapthrough
