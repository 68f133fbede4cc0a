#pragma once
/// @file
/// Whether the monitor of a stop rule moves along the paths of an analysis.

#include <Eigen/Core>
#include <utility>

#include "solver/discrete/structure.h"
#include "solver/trace/path_observer.h"

namespace snapthrough {

/// @brief Compares what a monitor has moved by since the start of the first path with the displacements of
/// the whole structure. A monitor that symmetry, a support or a hinge keeps in place moves by rounding only:
/// a stop rule for its range cannot act.
class MonitorWatch final : public PathObserver {
 public:
  /// @param structure kept by reference
  /// @param row of the monitor, kept by reference; null: there is no such rule
  /// @param start unknowns that motions are counted from
  MonitorWatch(const Structure& structure, const SparseRow* row, Eigen::VectorXd start)
      : structure_(structure), row_(row), start_(std::move(start)) {}

  /// Whether the monitor has moved by more than rounding at scaled unknowns y.
  [[nodiscard]] bool has_moved(const Eigen::VectorXd& y) const;
  void on_point(const PathPoint& point) override;
  /// Whether the structure moved and the monitor did not at any point that was looked at.
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
