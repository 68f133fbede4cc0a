#pragma once
/// @file
/// Roots of the verification's own equations.

#include <functional>

namespace snapthrough::testing {

/// @brief Root of a function that has opposite signs at both ends, by halving to rounding.
inline double root(const std::function<double(double)>& f, double lo, double hi) {
  const bool rises = f(hi) > 0.0;
  for (;;) {
    const double middle = 0.5 * (lo + hi);
    if (!(middle > lo && middle < hi)) return middle;
    (((f(middle) > 0.0) == rises) ? hi : lo) = middle;
  }
}

}  // namespace snapthrough::testing
