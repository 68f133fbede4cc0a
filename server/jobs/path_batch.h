#pragma once
/// @file
/// Points of a path that are sent while the path grows.

#include <string>
#include <vector>

#include "solver/solve.h"

namespace snapthrough::server {

/// @brief Points that were traced since the last event. A batch has room for some 2 000 numbers; points that
/// come when it is full, and monitors after the first 100, are left out: the result has them.
class PathBatch {
 public:
  void add(const TracedPoint& point);
  [[nodiscard]] const std::vector<TracedPoint>& points() const { return points_; }
  [[nodiscard]] bool empty() const { return points_.empty(); }
  void clear();

 private:
  std::vector<TracedPoint> points_;
  std::size_t numbers_ = 0;
};

/// @brief Data of a `points` event (JSON text): the numbers of the points, column by column, with the
/// monitors of the first point. @pre the points are not empty
[[nodiscard]] std::string path_points_document(const std::vector<TracedPoint>& points);

}  // namespace snapthrough::server
