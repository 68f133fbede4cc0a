#pragma once
/// @file
/// A path from the start of a problem.

#include "solver/trace/trace.h"

namespace snapthrough::testing {

inline TraceOutcome follow(EquilibriumProblem& problem, const TraceRules& rules) {
  Continuation continuation(problem, {});
  return trace(continuation, continuation.start(), rules, {}, {}, {});
}

}  // namespace snapthrough::testing
