#pragma once
/// @file
/// Places on a member's axis where a displacement is largest.

#include <array>
#include <functional>
#include <vector>

#include "solver/geometry/axis_curve.h"

namespace snapthrough {

/// @brief Fractions of a member that divide a range of it into parts on which the displacement of a rigid
/// motion along the axis' normal has one maximum or two at most; with both ends of the range.
[[nodiscard]] std::vector<double> places_on(const AxisCurve& axis, const std::array<double, 2>& range);

/// @brief Fractions of a member, within a range, at which a function of the fraction has its local maxima.
[[nodiscard]] std::vector<double> places_of_maxima(const AxisCurve& axis, const std::array<double, 2>& range,
                                                   const std::function<double(double)>& value);

}  // namespace snapthrough
