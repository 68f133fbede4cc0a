#pragma once
/// @file
/// Kinks: places where a path turns sharply because a support begins or ceases to act.

#include "solver/path/step_trial.h"

namespace snapthrough {

/// @brief Takes the path round a kink that is within `size` of `from`.
///
/// The path goes back against its tangent there, or so nearly across it that no step along the tangent meets
/// it again. Points beyond the kink are tried at distances from 1000 to 10 times `size`, because stiff
/// supports that hardly touch show nothing nearby. The load's sense there is that which keeps the sign of det
/// [J, -load; tangent], or the opposite one where several supports change at once.
/// @return whether `to` was set: a point ten times as far from `from` as the point beyond the kink
[[nodiscard]] bool step_around_kink(PointSolver& solver, const StepLimits& limits, const PathPoint& from,
                                    const StepSizes& sizes, PathPoint& to);

/// @brief The last point before a kink that is within `sizes.size` of `from`, found by halving steps: a step
/// is taken when it ends before the kink.
[[nodiscard]] PathPoint last_point_before_kink(PointSolver& solver, const StepLimits& limits,
                                               const PathPoint& from, StepSizes sizes);

}  // namespace snapthrough
