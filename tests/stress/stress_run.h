#pragma once
/// @file
/// One model of the stress test: solve with all states, check. Or one seed: draw it first.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/stress/random_model.h"
#include "tests/stress/result_check.h"

namespace snapthrough::testing {

/// Which generator a seed belongs to. A generator is never changed, since docs/stress.md tells of its seeds:
/// a wider one is added.
enum class Draw { first, broad, laws, media, soil, members };

/// Draw of a name; empty for another text.
[[nodiscard]] std::optional<Draw> draw_named(std::string_view name);
[[nodiscard]] RandomRequest draw_request(Draw draw, std::uint64_t seed);

struct StressOutcome {
  std::string termination;  ///< the result's own word
  std::string detail;       ///< of a failure: where it stood
  bool reached = false;     ///< a stop rule that was asked for
  bool said_where = true;   ///< not reached: ended with a code and a sentence
  ResultCheck check;
  double seconds = 0.0;                        ///< of the solution
  std::string features;                        ///< what the model has, in a few words
  std::vector<CriticalPoint> critical_points;  ///< in the order of the result
  double end_load_factor = 0.0;                ///< of the primary path, if there is one
};

/// @param time_bound_s processor time after which the solver is asked to stop
[[nodiscard]] StressOutcome run_request(RandomRequest request, double time_bound_s);

[[nodiscard]] StressOutcome run_seed(Draw draw, std::uint64_t seed, double time_bound_s);

}  // namespace snapthrough::testing
