#pragma once
/// @file
/// Places where a sampled function changes its sign.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace snapthrough::testing {

/// Where f is extreme in [a, b], by golden sections: its minimum where it comes from above, else its maximum.
template <class Function>
double extremum(const Function& f, double a, double b, bool from_above) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  const double sign = from_above ? 1.0 : -1.0;
  for (int it = 0; it < 60; ++it) {
    const double left = b - ratio * (b - a);
    const double right = a + ratio * (b - a);
    (sign * f(left) < sign * f(right) ? b : a) = sign * f(left) < sign * f(right) ? right : left;
  }
  return 0.5 * (a + b);
}

/// Values g of a function at ascending places x.
struct Samples {
  std::vector<double> x, g;
};

/// Places where f changes its sign, ascending; pairs between samples are found by the extrema.
template <class Function>
std::vector<double> sign_changes(const Function& f, Samples of) {
  auto& [x, g] = of;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const bool above = g[i] > 0.0;
    if (std::abs(g[i]) > std::min(std::abs(g[i - 1]), std::abs(g[i + 1]))) continue;
    if ((g[i - 1] > 0.0) != above || (g[i + 1] > 0.0) != above) continue;
    const double at = extremum(f, x[i - 1], x[i + 1], above);
    const double extreme = f(at);
    if ((extreme > 0.0) == above) continue;
    const auto place = static_cast<std::ptrdiff_t>(i) + (at > x[i] ? 1 : 0);
    x.insert(x.begin() + place, at);
    g.insert(g.begin() + place, extreme);
    i += 2;
  }
  std::vector<double> out;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const bool before = g[i - 1] > 0.0;
    if ((g[i] > 0.0) == before) continue;
    double a = x[i - 1];
    double b = x[i];
    for (int it = 0; it < 60; ++it) {
      const double mid = 0.5 * (a + b);
      ((f(mid) > 0.0) == before ? a : b) = mid;
    }
    out.push_back(a);
  }
  return out;
}

}  // namespace snapthrough::testing
