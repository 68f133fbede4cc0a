#pragma once
/// @file
/// Depths between which curves are interpolated linearly.

#include <functional>
#include <optional>
#include <vector>

#include "api/soil/curves.h"

namespace snapthrough::api::soil {

/// Returns the force of a curve at a displacement >= 0.
[[nodiscard]] double force_at(const Curve& curve, double displacement);
/// Returns the largest force of a curve at displacements up to a limit; 0 without resistance.
[[nodiscard]] double largest_force(const Curve& curve, double limit);

struct CurveAtDepth {
  double depth = 0.0;
  Curve curve;
};

/// What interpolation of curves by depth keeps.
struct DepthAccuracy {
  double accuracy = 0.0;  ///< largest error of a force, over the largest force at its depth
  double limit = 0.0;     ///< largest displacement at which it holds, > 0
  double surface = 0.0;   ///< depth above which it need not hold
  double shortest = 0.0;  ///< least distance of depths
};

/// @brief Returns curves at depths from < ... < to between which linear interpolation by depth, at each
/// displacement, keeps an accuracy.
///
/// With P the largest force of a curve at displacements up to the limit, and P_0 the largest P at from, at to
/// and at the middle, the error at those displacements is at most accuracy max(P, accuracy P_0). Intervals
/// are halved until this holds at their middle and at both quarters; the error of a curve that bends once
/// between is at most 4/3 of the largest there. Curves that shrink to nothing at the surface would be halved
/// without end: hence P_0 and `surface`.
/// @param curve_at returns the curve at a depth
/// @return nullopt when depths would be nearer than `shortest`, and for more than kMaxBreakPoints depths
[[nodiscard]] std::optional<std::vector<CurveAtDepth>> curves_by_depth(
    const std::function<Curve(double)>& curve_at, double from, double to, const DepthAccuracy& wanted);

}  // namespace snapthrough::api::soil
