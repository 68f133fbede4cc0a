#pragma once
/// @file
/// Where a step crosses a bound of the stop rules.

#include <optional>

#include "solver/path/point_solver.h"
#include "solver/trace/trace_rules.h"

namespace snapthrough {

/// The point of a step that a bound ends the path at.
struct BoundedEnd {
  PathPoint point;
  bool found = false;  ///< false: the step crosses the bound and the crossing was not located
  TraceEnd end = TraceEnd::load_factor;
};

/// @brief The point where a step first crosses a bound; empty when it crosses none.
/// @param kink whether the path turns sharply on the step, so that rates jump
[[nodiscard]] std::optional<BoundedEnd> first_bound(PointSolver& solver, const TraceRules& rules,
                                                    const PathPoint& from, const PathPoint& to, bool kink);

}  // namespace snapthrough
