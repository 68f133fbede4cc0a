#include "solver/analysis/monitor_watch.h"

#include <algorithm>
#include <cmath>

#include "solver/numeric/rounding.h"

namespace snapthrough {

/// Largest displacement (over the length scale) or rotation (rad) of an element end since the start.
double MonitorWatch::largest_motion(const Eigen::VectorXd& y) const {
  double largest = 0.0;
  for (const ElementDofs& dofs : structure_.dofs)
    for (const auto& end : {dofs.a, dofs.b})
      for (const int dof : end) largest = std::max(largest, std::abs(y[dof] - start_[dof]));
  return largest;
}

bool MonitorWatch::has_moved(const Eigen::VectorXd& y) const {
  if (row_ == nullptr) return false;
  double unit = 0.0;
  for (const auto& [index, weight] : row_->entries) unit = std::max(unit, std::abs(weight));
  return std::abs(row_->dot(y) - row_->dot(start_)) >
         unit * std::max(Rounding::motion * largest_motion(y), Rounding::distance);
}

void MonitorWatch::on_point(const PathPoint& point) {
  if (row_ == nullptr) return;
  structure_moved_ = structure_moved_ || largest_motion(point.y) > 0.0;
  monitor_moved_ = monitor_moved_ || has_moved(point.y);
}

}  // namespace snapthrough
