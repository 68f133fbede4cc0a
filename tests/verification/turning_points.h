#pragma once
/// @file
/// Turning points of a monitor along a branch, to more digits than its steps have.

#include <cstddef>
#include <vector>

#include "solver/result.h"

namespace snapthrough::testing {

struct TurningPoint {
  double load_factor;
  double value;
};

/// Polynomial through `count` points (Newton's form) and its derivative, in a local variable.
class NewtonPolynomial {
 public:
  NewtonPolynomial(const std::vector<double>& t, const std::vector<double>& f, std::size_t from,
                   std::size_t count)
      : t_(t.begin() + static_cast<std::ptrdiff_t>(from),
           t.begin() + static_cast<std::ptrdiff_t>(from + count)),
        c_(f.begin() + static_cast<std::ptrdiff_t>(from),
           f.begin() + static_cast<std::ptrdiff_t>(from + count)) {
    for (std::size_t k = 1; k < count; ++k)
      for (std::size_t i = count - 1; i >= k; --i) c_[i] = (c_[i] - c_[i - 1]) / (t_[i] - t_[i - k]);
  }
  [[nodiscard]] double value(double t) const { return both(t)[0]; }
  [[nodiscard]] double slope(double t) const { return both(t)[1]; }

 private:
  struct Pair {
    double v[2];
    double operator[](int i) const { return v[i]; }
  };
  [[nodiscard]] Pair both(double t) const {
    double value = 0.0;
    double slope = 0.0;
    for (std::size_t i = c_.size(); i-- > 0;) {
      slope = slope * (t - t_[i]) + value;
      value = value * (t - t_[i]) + c_[i];
    }
    return {{value, slope}};
  }
  std::vector<double> t_;
  std::vector<double> c_;
};

/// @brief Where a monitor has an extremum along the branch: zero of the derivative of the polynomial through
/// the ten points around it, over arc length. Its error falls with the tenth power of the step.
inline std::vector<TurningPoint> turning_points(const Branch& branch, std::size_t monitor) {
  const std::vector<double>& f = branch.monitors[monitor].values;
  const std::vector<double>& s = branch.arc_length;
  constexpr std::size_t kPoints = 10;
  std::vector<TurningPoint> out;
  for (std::size_t i = kPoints / 2; i + kPoints / 2 < f.size(); ++i) {
    if ((f[i] - f[i - 1]) * (f[i + 1] - f[i]) >= 0.0) continue;
    const NewtonPolynomial value(s, f, i - kPoints / 2, kPoints);
    const NewtonPolynomial load(s, branch.load_factor, i - kPoints / 2, kPoints);
    double lo = s[i - 1];
    double hi = s[i + 1];
    for (int it = 0; it < 100; ++it) {
      const double middle = 0.5 * (lo + hi);
      ((value.slope(middle) > 0.0) == (value.slope(lo) > 0.0) ? lo : hi) = middle;
    }
    out.push_back({load.value(lo), value.value(lo)});
  }
  return out;
}

}  // namespace snapthrough::testing
