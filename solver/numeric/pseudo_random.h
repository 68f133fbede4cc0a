#pragma once
/// @file
/// Vectors without pattern, the same on every run.

#include <Eigen/Core>

namespace snapthrough {

/// @brief Entries in [-1/2, 1/2) by a linear congruential generator: a start of iterations that has a part
/// of every mode.
[[nodiscard]] inline Eigen::VectorXd pseudo_random(Eigen::Index size, unsigned seed) {
  Eigen::VectorXd x(size);
  unsigned state = seed * 2654435761U + 12345U;
  for (double& value : x) {
    state = state * 1664525U + 1013904223U;
    value = static_cast<double>(state >> 8) / static_cast<double>(1U << 24) - 0.5;
  }
  return x;
}

}  // namespace snapthrough
