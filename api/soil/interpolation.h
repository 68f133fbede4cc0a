#pragma once
/// @file
/// Depths between which a curve by depth is interpolated linearly.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "api/soil/ultimate_resistance.h"

namespace snapthrough::api::soil {

/// @brief Returns depths from < ... < to, of which each two neighbours satisfy `fits`.
///
/// Each part is about as long as it may be. @pre `fits` holds for parts of a part for which it holds
/// @return nullopt when a part would be shorter than `shortest`, and for more than kMaxBreakPoints depths
[[nodiscard]] std::optional<std::vector<double>> divide_depth(
    double from, double to, double shortest, const std::function<bool(double, double)>& fits);

/// Returns the resistance at a depth: not negative, as rounding makes one that vanishes.
[[nodiscard]] double resistance_at(const Piece& piece, double depth);

/// @brief Returns a bound of |L - f| / L between a and b, where L is the chord of f = piece.value.
///
/// With M the largest |f''|, |L - f| <= M (X - a)(b - X)/2, and (X - a)(b - X)/L <= (b - a)^2/(sqrt(f(a)) +
/// sqrt(f(b)))^2 by the inequality of Cauchy and Schwarz. The bound is M (b - a)^2 / (2 (sqrt(f(a)) +
/// sqrt(f(b)))^2).
[[nodiscard]] double chord_error(const Piece& piece, double a, double b);

/// @brief Returns break points of pieces whose linear interpolation L has |L - f| <= accuracy f everywhere.
/// @return nullopt when break points would be nearer than `shortest`, and for more than kMaxBreakPoints
[[nodiscard]] std::optional<std::vector<double>> break_depths(std::span<const Piece> pieces, double shortest,
                                                              double accuracy);

/// Returns the resistance of consecutive pieces at a depth. @pre the pieces contain the depth
[[nodiscard]] double value_at(std::span<const Piece> pieces, double depth);

}  // namespace snapthrough::api::soil
