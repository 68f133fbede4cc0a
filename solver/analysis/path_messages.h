#pragma once
/// @file
/// How a path ended, and what it met, in words.

#include <string>

#include "solver/analysis/monitor_watch.h"
#include "solver/model/analysis.h"
#include "solver/result.h"
#include "solver/trace/trace.h"

namespace snapthrough {

/// Termination code of a path.
[[nodiscard]] const char* code_of(TraceEnd end);
/// Whether a path that ends so failed.
[[nodiscard]] bool is_failure(TraceEnd end);

/// Sets termination and message of a path, and its failure.
/// @param at load factor at the path's end
void describe_end(const Analysis& analysis, const TraceOutcome& outcome, double at, Result& result);

/// Start of the message of a `path` analysis: the first loss of stability; empty: none.
[[nodiscard]] std::string loss_on_the_way(const Analysis& analysis, const Result& result);

/// Warns of a stop rule that is ineffective because its monitor does not move.
void warn_of_still_monitor(const Analysis& analysis, const MonitorWatch& watch, Result& result);

/// Sets the failure of a path that finer meshes do not confirm.
void fail_unconfirmed(const Analysis& analysis, Result& result);

}  // namespace snapthrough
