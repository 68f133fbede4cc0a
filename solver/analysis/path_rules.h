#pragma once
/// @file
/// What ends a path, by the request.

#include "solver/analysis/monitor_watch.h"
#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/trace/trace.h"

namespace snapthrough {

/// Rules of the request for a path and its branches.
[[nodiscard]] TraceRules rules_of(const Analysis& analysis, const Structure& structure);

/// Row of the monitor of the stop rule; null: the request has no such rule.
[[nodiscard]] const SparseRow* row_of_stop(const Structure& structure, const Analysis& analysis);

/// @brief Limits the negative eigenvalues of a path: to the request's bound; else, without a bound on load
/// factor or steps, to a number more than at the start plus one per requested limit point. The latter limit
/// is suspended while the monitor of a stop rule moves.
/// @param watch must outlive `rules`
void bound_negative(const Analysis& analysis, int at_start, const MonitorWatch& watch, TraceRules& rules);

}  // namespace snapthrough
