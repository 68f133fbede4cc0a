#pragma once
/// @file
/// Critical points of a path, and how exactly they are located.

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/path/path_point.h"
#include "solver/result.h"

namespace snapthrough {

/// A critical point of a path.
struct CriticalEvent {
  CriticalType type = CriticalType::bifurcation;
  CriticalCause cause = CriticalCause::smooth;
  PathPoint point;
  int negative_before = 0;    ///< negative eigenvalues on the side that the path comes from
  int negative_after = 0;     ///< negative eigenvalues beyond
  int multiplicity = 1;       ///< eigenvalues that vanish at the point
  bool after_growth = false;  ///< vibrations grow from an earlier point of the path on
  /// Null vectors, columns: the motion that loses its stiffness at the point, where it is known, then motions
  /// that lose it close by.
  Eigen::MatrixXd null;
  double imperfection = 0.0;  ///< size of what breaks a bifurcation, see CriticalSolution
  /// Direction of the path that crosses at a bifurcation, of norm one; empty: not known.
  Eigen::VectorXd across;
  double across_lambda = 0.0;
  double bracket_loads[2] = {};  ///< scaled load factors at the ends of the final bracket
};

/// @brief Whether vibrations begin to grow at a point, where the inertia of the tangent tells nothing.
template <class Critical>
[[nodiscard]] bool grows_from(const Critical& point) {
  return point.type == CriticalType::flutter || point.cause == CriticalCause::massless;
}

/// @brief Whether a stable path loses stability at a point that it meets.
[[nodiscard]] inline bool is_loss(const CriticalEvent& event) {
  return event.type != CriticalType::broken_bifurcation && !event.after_growth &&
         event.negative_before == 0 && (event.negative_after > 0 || grows_from(event));
}

/// How exactly critical points are located.
struct LocateOptions {
  double tolerance = 1e-9;  ///< on the load factor, relative
  /// Largest imperfection of a bifurcation that counts as perfect: above what rounding of the nodes'
  /// coordinates or a mesh makes, below what can be built.
  double perfect = 1e-8;
  /// Largest distance of the last point before a kink from the end of the step that led round it, over the
  /// displacement there, at which a change of inertia may be put at that point.
  double before_kink = std::numeric_limits<double>::infinity();
};

/// What was found on one step.
struct LocatedEvents {
  std::vector<CriticalEvent> events;  ///< in the order in which the path meets them
  bool same_path = true;              ///< false: the ends of the step are on two different paths
  /// Places where a stiffness falls to zero within rounding and rises again: two critical points may lie
  /// there, or none.
  std::vector<PathPoint> touching;
};

/// @brief Type of the limit point that a path meets beyond a point.
[[nodiscard]] inline CriticalType limit_type(const PathPoint& before) {
  return before.tangent_lambda > 0.0 ? CriticalType::limit_max : CriticalType::limit_min;
}

/// @brief Share of a bifurcation's load within which an imperfection turns the path away from it: Koiter's
/// two-thirds power, with a factor above all that were measured (docs/stress.md).
[[nodiscard]] inline double broken_share(double imperfection) {
  return 10.0 * std::pow(imperfection, 2.0 / 3.0);
}
/// @brief The imperfection with this share.
[[nodiscard]] inline double imperfection_of(double share) { return std::pow(0.1 * share, 1.5); }

}  // namespace snapthrough
