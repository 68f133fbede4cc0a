#pragma once
/// @file
/// The least stiffness along a path, relative to that of the unloaded structure, and where it is lowest.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/path/point_solver.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Finds the first local minimum of the stiffness ratio below a tenth before a path loses stability,
/// or the lowest where none is below.
///
/// The stiffness of a motion n is n.J n / n.W n, with J the tangent stiffness and W the metric of
/// displacement gradients; the least over all motions is the smallest eigenvalue of J n = k W n. The
/// stiffness ratio is that eigenvalue over the one of the unloaded structure. (Bergan's current stiffness
/// parameter compares the stiffnesses along the path's direction alone, which a motion across the path does
/// not lower.)
///
/// A structure whose perfect form has a bifurcation passes near it when it is imperfect: the ratio falls to
/// nearly zero and rises again, displacements are large from there on, and the limit point beyond is out of
/// reach of a design.
class SoftestPoint {
 public:
  /// @param solver of the path's points; kept by reference
  explicit SoftestPoint(PointSolver& solver) : solver_(solver) {}

  /// Sets the stiffness that ratios are relative to, once. @param unloaded with its modes
  void set_unloaded(const PathPoint& unloaded);
  /// @return empty where the eigenvalues are not known at the point, or not for the unloaded structure
  [[nodiscard]] std::optional<double> ratio(const PathPoint& point) const;
  /// @brief Looks for a minimum on a step of the primary path.
  /// @param from, to ends of the step, on one path; with their modes
  void add_step(const PathPoint& from, const PathPoint& to);
  /// Says that the path loses stability at a point of the step that add_step() gets next; it is the last one.
  void lose(const PathPoint& critical) { critical_ = critical; }

  /// @brief Puts summary.softest into a result, and the warning and the sentence that begins its message
  /// where the ratio falls below a tenth.
  ///
  /// Where the ratio has no minimum before the critical point, the softest point is that one.
  /// @pre result.summary has its final critical load and message
  void report(const Structure& structure, const Model& model, const Analysis& analysis, Result& result) const;

 private:
  /// A local minimum of the stiffness between two points of the path.
  void search(PathPoint low, PathPoint high);
  /// A local minimum before a maximum, where the stiffness falls at both points.
  void search_before_fall(const PathPoint& from, const PathPoint& to);
  /// A local minimum between a point and the critical point, where the stiffness is zero.
  void search_before_critical(PathPoint from);

  PointSolver& solver_;
  double unloaded_ = 0.0;  ///< least stiffness of the unloaded structure; 0: not known
  std::optional<PathPoint> critical_;
  bool ended_ = false;
  std::optional<PathPoint> lowest_;  ///< with its modes; the first one below a tenth
};

/// @brief Largest displacement, rotation and strain of a state, for Summary::at_critical.
/// @param y scaled unknowns
[[nodiscard]] AtCritical at_critical(const Structure& structure, const Model& model,
                                     const Eigen::VectorXd& y);

}  // namespace snapthrough
