#pragma once
/// @file
/// Detects whether the monitor of a stop rule moves along the paths of an analysis.

#include <Eigen/Core>
#include <utility>

#include "solver/discrete/structure.h"
#include "solver/trace/path_observer.h"

namespace snapthrough {

/// @brief Compares the motion of a monitor since the start with the displacements of the structure. A monitor
/// fixed by symmetry, a support or a hinge moves by rounding only; a stop rule on its range has no effect.
class MonitorWatch final : public PathObserver {
 public:
  /// @param structure kept by reference
  /// @param row row of the monitor, kept by reference; null: the analysis has no such rule
  /// @param start unknowns of the reference state
  MonitorWatch(const Structure& structure, const SparseRow* row, Eigen::VectorXd start)
      : structure_(structure), row_(row), start_(std::move(start)) {}

  /// Whether the monitor has moved by more than rounding at scaled unknowns y.
  [[nodiscard]] bool has_moved(const Eigen::VectorXd& y) const;
  void on_point(const PathPoint& point) override;
  /// Whether the structure moved, but the monitor did not, at all examined points.
  [[nodiscard]] bool is_still() const { return row_ != nullptr && structure_moved_ && !monitor_moved_; }

 private:
  [[nodiscard]] double largest_motion(const Eigen::VectorXd& y) const;

  const Structure& structure_;
  const SparseRow* row_;
  Eigen::VectorXd start_;
  bool structure_moved_ = false;
  bool monitor_moved_ = false;
};

}  // namespace snapthrough
