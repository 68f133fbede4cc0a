#pragma once
/// @file
/// Times of whole solutions, for programs that print them themselves.

#include <algorithm>
#include <array>
#include <chrono>

#include "solver/solve.h"

namespace snapthrough::bench {

/// @brief Median milliseconds of 21 solutions; `result` is the last one's.
inline double median_milliseconds(const Model& model, const Analysis& analysis, Result& result) {
  std::array<double, 21> times{};
  for (double& time : times) {
    const auto start = std::chrono::steady_clock::now();
    result = solve(model, analysis);
    time = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  std::nth_element(times.begin(), times.begin() + 10, times.end());
  return times[10];
}

}  // namespace snapthrough::bench
