#include "solver/analysis/monitor_watch.h"

#include <algorithm>
#include <cmath>

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
  constexpr double kOfMotion = 1e-9;  // rounding, over the largest displacement
  constexpr double kOfSize = 1e-12;   // rounding of positions, over the length scale or 1 rad
  if (row_ == nullptr) return false;
  double unit = 0.0;
  for (const auto& [index, weight] : row_->entries) unit = std::max(unit, std::abs(weight));
  return std::abs(row_->dot(y) - row_->dot(start_)) > unit * std::max(kOfMotion * largest_motion(y), kOfSize);
}

void MonitorWatch::on_point(const PathPoint& point) {
  if (row_ == nullptr) return;
  structure_moved_ = structure_moved_ || largest_motion(point.y) > 0.0;
  monitor_moved_ = monitor_moved_ || has_moved(point.y);
}

}  // namespace snapthrough
