#pragma once
/// @file
/// Waits for events that must come, however busy the machine is.

#include <chrono>
#include <thread>

namespace snapthrough::server::test {

/// Longest time that a test waits for an event that must come. It decides only when a test fails whose event
/// does not come: no test may succeed or fail by how fast the machine is.
inline constexpr std::chrono::seconds kPatience{100};

/// Waits until a condition holds, which is looked at every 5 ms. Returns whether it held within kPatience.
template <class Condition>
[[nodiscard]] bool eventually(const Condition& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace snapthrough::server::test
