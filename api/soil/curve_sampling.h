#pragma once
/// @file
/// Curves in pieces, and their replacement by straight lines. Internal to api/soil/.

#include <functional>
#include <vector>

#include "api/soil/curves.h"

namespace snapthrough::api::soil {

/// Part of a curve from where the one before it ends, or from the origin.
struct Stretch {
  double to = 0.0;  ///< displacement at its end
  /// Force of a displacement: continues the stretch before, concave or convex.
  std::function<double(double)> force;
  bool is_straight = false;
};

/// Returns a straight stretch between two points.
[[nodiscard]] Stretch line(double from, double force_from, double to, double force_to);

/// @brief Returns a curve that begins with the straight line of a stiffness and follows `stretches` from
/// where they come below that line.
///
/// The line goes on to the last force if the stretches stay above it. There is no line if they begin below
/// it.
/// @param stretches force over displacement does not increase along them
/// @param stiffness >= 0; 0: the curve has no force
[[nodiscard]] std::vector<Stretch> below_line(std::vector<Stretch> stretches, double stiffness);

/// @brief Returns straight lines that differ from the stretches by at most `accuracy` times the largest
/// force.
///
/// Ends of stretches are points. Negative forces are replaced by 0.
[[nodiscard]] Curve sampled(const std::vector<Stretch>& stretches, double accuracy);

}  // namespace snapthrough::api::soil
