#pragma once
/// @file
/// Values that vary along a member.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace snapthrough {

/// Values at fractions of a member's length, which ascend; linear in between, and constant before the first
/// and beyond the last fraction. Empty where the value does not vary.
template <class T>
using Along = std::vector<std::pair<double, T>>;

/// Value at a share of the way from one value to another.
inline double between(double from, double to, double share) { return from + share * (to - from); }
inline std::array<double, 2> between(const std::array<double, 2>& from, const std::array<double, 2>& to,
                                     double share) {
  return {between(from[0], to[0], share), between(from[1], to[1], share)};
}

/// Value at a fraction of the member; `constant` if the value does not vary.
template <class T>
[[nodiscard]] T value_at(const T& constant, const Along<T>& along, double fraction) {
  if (along.empty()) return constant;
  const auto next = std::upper_bound(along.begin(), along.end(), fraction,
                                     [](double f, const auto& point) { return f < point.first; });
  if (next == along.begin()) return along.front().second;
  if (next == along.end()) return along.back().second;
  const auto& before = *(next - 1);
  return between(before.second, next->second, (fraction - before.first) / (next->first - before.first));
}

/// Derivative of value_at() by the fraction; at a bend that of the part beyond.
[[nodiscard]] inline double slope_at(const Along<double>& along, double fraction) {
  const auto next = std::upper_bound(along.begin(), along.end(), fraction,
                                     [](double f, const auto& point) { return f < point.first; });
  if (next == along.begin() || next == along.end()) return 0.0;
  return (next->second - (next - 1)->second) / (next->first - (next - 1)->first);
}

/// Number of a law that may vary along its member.
struct AlongMember {
  double constant = 0.0;  ///< used without points
  Along<double> points;

  [[nodiscard]] bool varies() const { return !points.empty(); }
  [[nodiscard]] double at(double fraction) const { return value_at(constant, points, fraction); }
  [[nodiscard]] double largest() const {
    double out = points.empty() ? constant : points.front().second;
    for (const auto& point : points) out = std::max(out, point.second);
    return out;
  }
  bool operator==(const AlongMember&) const = default;
};

}  // namespace snapthrough
