#pragma once
/// @file
/// Rows of a branch of a path: the computed points, and points between them.

#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <vector>

#include "solver/analysis/path_row.h"
#include "solver/events/contact_change.h"
#include "solver/events/critical_event.h"
#include "solver/path/point_solver.h"

namespace snapthrough {

/// @brief Stores the accepted, the critical points and the changes of contact of a branch until its rows are
/// made. The first point may have an empty tangent, which is then that of a parabola.
class PathPoints {
 public:
  /// Adds an accepted point; what was added since the previous one lies between both.
  /// @param ratio least stiffness over that of the unloaded structure
  void add(const PathPoint& point, std::optional<double> ratio) {
    accepted_.push_back({point, ratio, {}, {}});
  }
  /// @brief Adds a critical point between the last accepted point and the next one.
  /// @pre a point was added
  void add_critical(const CriticalEvent& event) { accepted_.back().then.push_back(event); }
  /// @brief Adds a change of contact between the last accepted point and the next one.
  /// @pre a point was added
  void add_change(const ContactChange& change) {
    accepted_.back().changes.insert(accepted_.back().changes.end(), {change.last_before, change.point});
  }
  /// Forgets the softest motions of the last point; spread() starts from them.
  void forget_modes() { accepted_.back().point.modes = nullptr; }
  /// Whether so many points are kept that follow() should make rows of most of them, which bounds the memory
  /// of long paths.
  [[nodiscard]] bool are_many() const { return accepted_.size() >= kMany; }

  /// @brief Visits all accepted and critical points in path order, with corrected points inserted between
  /// accepted ones so that no arc length between neighbours exceeds the branch's length over count - 1.
  /// @return number of points that could not be corrected (divergence or stop request)
  [[nodiscard]] int spread(PointSolver& solver, int count, const std::stop_token& stop,
                           const RowVisitor& visit);

  /// @brief Visits all added points in path order, with points inserted between them so that straight lines
  /// between neighbours follow the curves of the load factor over each shown value within a share of their
  /// ranges.
  ///
  /// The curve between two points is the cubic through both and their tangents. Its error is estimated from
  /// the cubics beside it; where it is too large, a point is corrected between both, and so on. Points of
  /// the cubics are inserted between those.
  /// @param last no more points follow; else the last ones are kept, and their rows are visited by later
  /// calls
  /// @return number of places where straight lines may be too far off, because no point could be corrected
  [[nodiscard]] int follow(PointSolver& solver, const ShownValues& shown, bool last,
                           const std::stop_token& stop, const RowVisitor& visit);

 private:
  static constexpr std::size_t kMany = 32;  ///< two vectors each
  struct Accepted {
    PathPoint point;
    std::optional<double> ratio;
    std::vector<CriticalEvent> then;  ///< critical points before the next accepted point
    std::vector<PathPoint> changes;   ///< points on both sides of each change of contact on the way to it
  };
  /// What a curve is made of, in path order.
  struct Parts {
    std::vector<PathPoint> nodes;
    std::vector<PathPoint> passed;    ///< critical points that the curve has no tangent of
    std::map<double, int> counts;     ///< negative eigenvalues from an arc length on
    std::map<double, double> ratios;  ///< stiffness ratios at arc lengths
  };
  void complete_tangents(const PathNorm& norm, bool last);
  [[nodiscard]] Parts parts(double least, bool last);

  std::vector<Accepted> accepted_;
  std::optional<double> visited_to_;  ///< arc length up to which rows were visited
  ShownRange range_;                  ///< range of all points so far
};

}  // namespace snapthrough
