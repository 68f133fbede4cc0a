#pragma once
/// @file
/// Cancellation of an analysis.

#include <stop_token>

namespace snapthrough {

/// Thrown by long computations when their stop token is set; never leaves solve() or follow_critical_point(),
/// which report what was reached.
struct Cancelled {};

/// @brief Checks and resets the token: a stop request throws once, and results can still be evaluated.
/// @throws Cancelled
inline void end_if_asked(std::stop_token& stop) {
  if (!stop.stop_requested()) return;
  stop = {};
  throw Cancelled{};
}

/// @brief Runs `work`. @return false when it was cancelled
template <class Work>
[[nodiscard]] bool unless_cancelled(Work work) {
  try {
    work();
    return true;
  } catch (const Cancelled&) {
    return false;
  }
}

}  // namespace snapthrough
