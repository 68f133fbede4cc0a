#pragma once
/// @file
/// Points of a path on their way to those who watch it grow.

#include <string>
#include <vector>

#include "solver/solve.h"

namespace snapthrough::server {

/// @brief Points that were traced since the latest were told. It has room for some 2 000 numbers: what comes
/// when it is full is left out, and so are monitors after the first 100, since the result has every point.
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

/// @brief The data of a `points` event (JSON text): what the points have, column by column. Monitors are
/// those of the first point. @pre not empty
[[nodiscard]] std::string path_points_document(const std::vector<TracedPoint>& points);

}  // namespace snapthrough::server
