#pragma once
/// @file
/// Free motions along a path: motions that nothing resists are pinned by springs, until something resists
/// them.

#include "solver/path/point_solver.h"

namespace snapthrough {

/// @brief Whether a step may have lost the resistance to a free motion: the determinant fell by the ratio at
/// which a stiffness counts as none.
[[nodiscard]] bool may_have_free_motion(const EquilibriumProblem& problem, const PathPoint& from,
                                        const PathPoint& to);

/// @brief Pins the motions that nothing resists at `to`, where they were at `from`, when they are more than
/// those pinned at `from`; corrects the point at its load and sets its tangent and inertia.
/// @return whether there are such motions; else the point stays as it is
[[nodiscard]] bool pin_free_motions(PointSolver& solver, const PathPoint& from, PathPoint& to);

/// @brief Takes the pins off those motions of `from` that have a stiffness or carry a force at `to`.
/// @return false when all motions that are pinned at `from` are still free at `to`
[[nodiscard]] bool unpin_resisted_motions(PointSolver& solver, PathPoint& from, const PathPoint& to);

}  // namespace snapthrough
