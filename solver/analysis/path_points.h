#pragma once
/// @file
/// Points evenly along a branch of a path.

#include <stop_token>
#include <vector>

#include "solver/events/critical_event.h"
#include "solver/path/point_solver.h"

namespace snapthrough {

/// @brief The accepted points of a branch and its critical ones, until its length is known.
class PathPoints {
 public:
  /// An accepted point; the critical points since the last one are between the two.
  void add(const PathPoint& point) { accepted_.push_back({point, {}}); }
  /// A critical point between the last accepted point and the next one.
  void add_critical(const CriticalEvent& event) { accepted_.back().then.push_back(event); }

  /// @brief The branch's points in order: those added, and between accepted ones others, equally spaced and
  /// corrected to equilibrium, so that no distance is longer than the branch's length over count - 1.
  /// @param missing overwritten: points that could not be corrected, or were not for the stop
  [[nodiscard]] std::vector<PathPoint> spread(PointSolver& solver, int count, const std::stop_token& stop,
                                              int& missing) const;

 private:
  struct Accepted {
    PathPoint point;
    std::vector<CriticalEvent> then;  ///< critical points between it and the next
  };
  std::vector<Accepted> accepted_;
};

}  // namespace snapthrough
