#pragma once
/// @file
/// How an analysis ends in the middle of its work.

#include <stop_token>

namespace snapthrough {

/// Thrown by what takes long when its stop token was asked to stop. It never leaves solve() or
/// follow_critical_point(): who knows what was reached says so.
struct Cancelled {};

/// @brief Looks at the token. What asks to stop is heard once: what was reached can still be evaluated.
/// @throws Cancelled
inline void end_if_asked(std::stop_token& stop) {
  if (!stop.stop_requested()) return;
  stop = {};
  throw Cancelled{};
}

/// @brief Does it. @return false when it was cancelled in between
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
