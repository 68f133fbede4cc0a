#pragma once
/// @file
/// Equally spaced points along a branch of a path.

#include <stop_token>
#include <vector>

#include "solver/events/critical_event.h"
#include "solver/path/point_solver.h"

namespace snapthrough {

/// @brief Stores the accepted and the critical points of a branch until its length is known.
class PathPoints {
 public:
  /// Adds an accepted point; critical points added since the previous one lie between both.
  void add(const PathPoint& point) { accepted_.push_back({point, {}}); }
  /// Adds a critical point between the last accepted point and the next one.
  void add_critical(const CriticalEvent& event) { accepted_.back().then.push_back(event); }

  /// @brief All added points in path order, with corrected points inserted between accepted ones so that no
  /// arc length between neighbours exceeds the branch's length over count - 1.
  /// @param missing overwritten by the number of points that were not corrected (divergence or stop request)
  [[nodiscard]] std::vector<PathPoint> spread(PointSolver& solver, int count, const std::stop_token& stop,
                                              int& missing) const;

 private:
  struct Accepted {
    PathPoint point;
    std::vector<CriticalEvent> then;  ///< critical points before the next accepted point
  };
  std::vector<Accepted> accepted_;
};

}  // namespace snapthrough
