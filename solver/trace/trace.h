#pragma once
/// @file
/// The path from its first point until a stop rule is met.

#include <optional>
#include <stop_token>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/path/path_follower.h"
#include "solver/trace/path_observer.h"
#include "solver/trace/trace_rules.h"

namespace snapthrough {

struct TraceOutcome {
  TraceEnd end = TraceEnd::no_start;
  PathPoint last;
  std::vector<CriticalEvent> critical;
  /// `last` is a critical point: the last of `critical` that the path did not pass by.
  bool on_critical = false;
};

/// @brief Follows the path from `start`; the first rule met ends it, exactly at the rule's value.
/// @param start of the path (path_start.h); empty: the outcome is `no_start`
[[nodiscard]] TraceOutcome trace(PathFollower& follower, const std::optional<PathPoint>& start,
                                 const TraceRules& rules, const StepOptions& steps,
                                 const PathObservers& observers, const std::stop_token& stop);

}  // namespace snapthrough
