#pragma once
/// @file
/// Reproducible pseudo-random vectors.

#include <Eigen/Core>

namespace snapthrough {

/// @brief Vector with entries in [-1/2, 1/2) from a linear congruential generator; initial vector of
/// iterations, with components in all modes.
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
