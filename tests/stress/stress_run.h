#pragma once
/// @file
/// One seed of the stress test: draw, solve, check.

#include <cstdint>
#include <string>

#include "tests/stress/result_check.h"

namespace snapthrough::testing {

/// Which generator a seed belongs to. A generator is never changed once seeds of it are regressions: a wider
/// one is added.
enum class Draw { first, broad };

struct StressOutcome {
  std::string termination;  ///< the result's own word
  std::string detail;       ///< of a failure: where it stood
  bool reached = false;     ///< a stop rule that was asked for
  bool said_where = true;   ///< not reached: ended with a code and a sentence
  ResultCheck check;
  double seconds = 0.0;  ///< of the solution
  std::string features;  ///< what the model has, in a few words
};

[[nodiscard]] StressOutcome run_seed(Draw draw, std::uint64_t seed, double time_bound_s);

}  // namespace snapthrough::testing
