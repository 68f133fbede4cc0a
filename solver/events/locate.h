#pragma once
/// @file
/// One locator for everything that happens between two points of a path.

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "solver/path/continuation.h"
#include "solver/path/path_point.h"
#include "solver/result.h"

namespace snapthrough {

/// A critical point of a path.
struct CriticalEvent {
  CriticalType type = CriticalType::bifurcation;
  CriticalCause cause = CriticalCause::smooth;
  PathPoint point;
  int negative_before = 0;
  int negative_after = 0;
  int multiplicity = 1;  ///< eigenvalues that vanish there
  /// The motion without stiffness, where it was found with the point, first; then those that lose it close
  /// by.
  Eigen::MatrixXd null;
  double imperfection = 0.0;  ///< size of what breaks a bifurcation, see CriticalSolution
  /// Direction of the path that crosses at a bifurcation, of norm one; empty: not known.
  Eigen::VectorXd across;
  double across_lambda = 0.0;
  double bracket_loads[2] = {};  ///< load factors at the ends of the final bracket
};

/// A place where a function of the path is zero, in a bracket that was never left.
struct LocatedRoot {
  PathPoint before;  ///< bracket end towards the start
  PathPoint after;
  PathPoint root;  ///< the better end, or a point between
  double value_before = 0.0;
  double value_after = 0.0;
  bool found = false;  ///< false: the two ends are on different paths, or no point between converged
};

/// @brief Finds a sign change of `value` between two path points by a bracketed secant.
///
/// Each trial is placed just beyond the secant's estimate, so that the bracket closes from both sides; a
/// bracket that does not shrink is halved. Ends that stay apart while their places along the chord approach
/// are on two different paths.
/// @param value_a, value_b values at the ends, of opposite sign (or one of them zero)
/// @param done whether a bracket is small enough: given both ends and the value at the better one
[[nodiscard]] LocatedRoot find_root(
    Continuation& continuation, const Chord& chord, const PathPoint& a, double value_a, const PathPoint& b,
    double value_b, const std::function<double(const PathPoint&)>& value,
    const std::function<bool(const PathPoint&, const PathPoint&, double)>& done);

/// Relative difference of two load factors that counts as none.
inline constexpr double kSameLoadFactor = 1e-11;

/// @brief Moves a point of a path that is next to a load onto it: a root along a step is known to a share of
/// the step, which is far longer than the load where the load moves the structure little.
/// @post unless the load is 0 or equilibrium is not found there, the point's load is it to kSameLoadFactor
void move_to_load(Continuation& continuation, double load, PathPoint& at);

/// @brief The point of the path between a and b that has the load, see move_to_load().
/// @pre the loads of a and b are on both sides of it
[[nodiscard]] PathPoint point_at_load(Continuation& continuation, const PathPoint& a, const PathPoint& b,
                                      double load);

/// What was found on one step.
struct LocatedEvents {
  std::vector<CriticalEvent> events;  ///< in the order they are met
  bool same_path = true;              ///< false: the step jumped, its ends are not on one continuous path
  /// Places where a stiffness falls to zero within rounding and rises again: two critical points may lie
  /// there, or none.
  std::vector<PathPoint> touching;
};

/// How points are located.
struct LocateOptions {
  double tolerance = 1e-9;  ///< on the load factor, relative
  /// Largest imperfection of a bifurcation that is one: beyond what rounding of the nodes' coordinates makes,
  /// or a mesh, and below what can be built.
  double perfect = 1e-8;
};

/// @brief Share of a bifurcation's load within which an imperfection of this size turns the path away from
/// it: Koiter's two-thirds power, with a factor above those that were seen.
[[nodiscard]] inline double broken_share(double imperfection) {
  return 10.0 * std::pow(imperfection, 2.0 / 3.0);
}
/// @brief The imperfection with this share.
[[nodiscard]] inline double imperfection_of(double share) { return std::pow(0.1 * share, 1.5); }

/// A fall and rise of a motion's stiffness between two points of a path.
struct Dip {
  Eigen::Index mode = 0;  ///< of those at the first point
  double share = 0.5;     ///< of the way, where the tangents of the stiffness meet
};

/// @brief Whether a motion's stiffness falls towards zero from a and rises to b, so that its tangents meet
/// beyond zero: then it may pass zero twice between them, and leave the inertia as it was.
/// @param length of the way from a to b
[[nodiscard]] std::optional<Dip> find_dip(const PathPoint& a, const PathPoint& b, double length);

/// @brief All critical points between two neighbouring points of a path, in the order they are met.
///
/// Limit points are zeros of dlambda/ds, simple bifurcations zeros of det(J) / (dlambda/ds), which changes
/// its sign at no limit point; the inertia tells that something is there and how much of it, and separates
/// what is close together by bisection. What stays together within the tolerance is one point of higher
/// multiplicity.
///
/// Where the softest motions at both ends are known, a simple point is found by Newton's method, and two that
/// leave the inertia as it was are seen by the motion's stiffness.
[[nodiscard]] LocatedEvents locate_critical_points(Continuation& continuation, const PathPoint& a,
                                                   const PathPoint& b, const LocateOptions& options);

/// @brief As locate_critical_points(), for a step that led round a kink (StepOutcome::kinked): places are
/// told by the displacement alone. What cannot be bracketed there is put at the last point before the kink,
/// caused by contact.
/// @param size of the step that was taken
[[nodiscard]] LocatedEvents locate_at_kink(Continuation& continuation, const PathPoint& a, const PathPoint& b,
                                           double size, const LocateOptions& options);

}  // namespace snapthrough
