#pragma once
/// @file
/// Values that vary along a member.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace snapthrough {

/// Values at fractions of a member's length, which ascend; linear in between unless a power is given, and
/// constant before the first and beyond the last fraction. Empty where the value does not vary.
template <class T>
using Along = std::vector<std::pair<double, T>>;

/// Value at a share of the way between two values of the same sign, whose power 1/n is linear on the way:
/// with r = (to / from)^(1/n), the value is from (1 + share (r - 1))^n. Logarithms keep it exact for large n.
inline double between(double from, double to, double share, double n = 1.0) {
  if (n == 1.0) return from + share * (to - from);
  if (std::abs(to) > std::abs(from)) return between(to, from, 1.0 - share, n);
  if (from == to) return from;
  return from * std::exp(n * std::log1p(share * std::expm1(std::log(to / from) / n)));
}
inline std::array<double, 2> between(const std::array<double, 2>& from, const std::array<double, 2>& to,
                                     double share, double n = 1.0) {
  return {between(from[0], to[0], share, n), between(from[1], to[1], share, n)};
}

/// Value at a fraction of the member; `constant` if the value does not vary.
/// @param power n of between()
template <class T>
[[nodiscard]] T value_at(const T& constant, const Along<T>& along, double fraction, double power = 1.0) {
  if (along.empty()) return constant;
  const auto next = std::upper_bound(along.begin(), along.end(), fraction,
                                     [](double f, const auto& point) { return f < point.first; });
  if (next == along.begin()) return along.front().second;
  if (next == along.end()) return along.back().second;
  const auto& before = *(next - 1);
  return between(before.second, next->second, (fraction - before.first) / (next->first - before.first),
                 power);
}

/// Derivative of value_at() by the fraction; at a bend that of the part beyond.
[[nodiscard]] inline double slope_at(const Along<double>& along, double fraction) {
  const auto next = std::upper_bound(along.begin(), along.end(), fraction,
                                     [](double f, const auto& point) { return f < point.first; });
  if (next == along.begin() || next == along.end()) return 0.0;
  return (next->second - (next - 1)->second) / (next->first - (next - 1)->first);
}

/// Number that may vary along a member.
struct AlongMember {
  double constant = 0.0;  ///< used without points
  Along<double> points;
  double power = 1.0;  ///< value^(1/power) is linear between the points; numbers of laws keep 1

  /// Implicit, because a number is the same along a member.
  AlongMember(double value = 0.0) : constant(value) {}  // NOLINT(google-explicit-constructor)
  explicit AlongMember(Along<double> values, double n = 1.0) : points(std::move(values)), power(n) {}

  [[nodiscard]] bool varies() const { return !points.empty(); }
  [[nodiscard]] double at(double fraction) const { return value_at(constant, points, fraction, power); }
  [[nodiscard]] double largest() const {
    double out = points.empty() ? constant : points.front().second;
    for (const auto& point : points) out = std::max(out, point.second);
    return out;
  }
  [[nodiscard]] double least() const {
    double out = points.empty() ? constant : points.front().second;
    for (const auto& point : points) out = std::min(out, point.second);
    return out;
  }
  AlongMember& operator*=(double factor) {
    constant *= factor;
    for (auto& point : points) point.second *= factor;
    return *this;
  }
  bool operator==(const AlongMember&) const = default;
};

}  // namespace snapthrough
