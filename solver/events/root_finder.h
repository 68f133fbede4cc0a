#pragma once
/// @file
/// Places between two points of a path where a function of the path is zero, or its load has a value.

#include <functional>
#include <optional>

#include "solver/path/path_point.h"
#include "solver/path/segment.h"

namespace snapthrough {

/// A place where a function of the path is zero, in a bracket that was never left.
struct LocatedRoot {
  PathPoint before;  ///< end of the bracket towards the start
  PathPoint after;   ///< the other end
  PathPoint root;    ///< the end with the smaller value
  double value_before = 0.0;
  double value_after = 0.0;
  bool found = false;  ///< false: the two ends are on different paths, or no point between them converged
};

/// A function of the path, and whether a bracket of its zero is small enough, given both ends and the smaller
/// of the values there.
struct RootFunction {
  std::function<double(const PathPoint&)> value;
  std::function<bool(const PathPoint& before, const PathPoint& after, double least)> is_closed;
};

/// @brief Finds a sign change of a function on a segment by a bracketed secant.
///
/// Each trial is placed just beyond the secant's estimate, so that the bracket closes from both sides; a
/// bracket that does not shrink is halved.
/// @param value_from, value_to values at the ends, of opposite sign (or one of them zero)
[[nodiscard]] LocatedRoot find_root(const Segment& segment, double value_from, double value_to,
                                    const RootFunction& function);

/// @brief Whether the ends of a segment are farther apart than their places along its direction allow: they
/// are on two different paths.
[[nodiscard]] bool on_different_paths(const Segment& segment);

/// Points located on a path. Source: docs/decisions/0010 and 0022.
struct LocatedPoints {
  /// Distance of two points, a displacement gradient, within which they are on one path: rounding leaves
  /// about 1e-16 over the relative distance to a bifurcation, a broken bifurcation about the cube root of its
  /// imperfection.
  static constexpr double same_path = 1e-5;
};

/// Relative difference of two load factors that counts as none.
inline constexpr double kSameLoadFactor = 1e-11;

/// @brief The equilibrium at a load, from a point of a path next to it. (A root along a step is known to a
/// share of the step, which is far longer than the load's change where the load hardly moves the structure.)
/// @return a point whose load is the given one to kSameLoadFactor; empty when no equilibrium is found there
[[nodiscard]] std::optional<PathPoint> moved_to_load(PointSolver& solver, double load,
                                                     const PathPoint& point);

/// @brief The point of the path between a and b that has a load.
///
/// Newton's method looks for it from the place on the segment where the load is met, then, on one-sided
/// supports, corrections that lower the energy from either end. A state farther from a and b than a path
/// between them leads is not on that path.
/// @pre the loads of a and b are on both sides of it
/// @return a point whose load is the given one to kSameLoadFactor; empty when no such point is found
[[nodiscard]] std::optional<PathPoint> point_at_load(PointSolver& solver, const PathPoint& a,
                                                     const PathPoint& b, double load);

}  // namespace snapthrough
