#pragma once
/// @file
/// Division of a line action where the numbers that it follows from are given.

#include <array>
#include <vector>

#include "solver/resolve/action.h"

namespace snapthrough {

/// @brief Pieces of a range between the fractions at which a number is given.
/// @param force_at force per length at a fraction
template <class T, class ForceAt>
[[nodiscard]] std::vector<LinePiece> pieces_between(const std::array<double, 2>& range, const Along<T>& along,
                                                    ForceAt force_at) {
  std::vector<LinePiece> out;
  double from = range[0];
  const auto add_until = [&](double to) {
    out.push_back({{from, to}, force_at(from), force_at(to)});
    from = to;
  };
  for (const auto& [fraction, value] : along)
    if (fraction > from + kOnePlace && fraction < range[1] - kOnePlace) add_until(fraction);
  add_until(range[1]);
  return out;
}

/// Pieces of a range between the fractions at which a force is given. @param along empty: `force` everywhere
[[nodiscard]] inline std::vector<LinePiece> pieces_of(const std::array<double, 2>& range,
                                                      const std::array<double, 2>& force,
                                                      const Along<std::array<double, 2>>& along) {
  return pieces_between(range, along, [&](double fraction) { return value_at(force, along, fraction); });
}

}  // namespace snapthrough
