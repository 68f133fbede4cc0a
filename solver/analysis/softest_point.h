#pragma once
/// @file
/// Least stiffness along a path relative to that of the unloaded structure, and its minimum.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/path/point_solver.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Finds the first local minimum of the stiffness ratio below 0.1 before stability is lost, or else
/// the lowest minimum.
///
/// The stiffness of a motion n is n.J n / n.W n (J: tangent stiffness, W: metric of displacement gradients).
/// Its least value over all motions is the smallest eigenvalue k of J n = k W n; the stiffness ratio is this
/// eigenvalue over that of the unloaded structure. (Bergan's current stiffness parameter compares stiffnesses
/// along the path only, and does not detect a soft motion across the path.)
///
/// An imperfect structure passes near the bifurcation of its perfect form: the ratio falls to nearly zero and
/// rises again, displacements are large from there on, and the limit point beyond is no design load.
class SoftestPoint {
 public:
  /// @param solver of the path's points; kept by reference
  explicit SoftestPoint(PointSolver& solver) : solver_(solver) {}

  /// Sets the reference stiffness at the first call. @param unloaded unloaded state with its modes
  void set_unloaded(const PathPoint& unloaded);
  /// @brief Stiffness ratio at a point; empty when its eigenvalues or those of the unloaded state are
  /// unknown.
  [[nodiscard]] std::optional<double> ratio(const PathPoint& point) const;
  /// @brief Searches a step of the primary path for a minimum.
  /// @param from, to ends of the step with their modes
  void add_step(const PathPoint& from, const PathPoint& to);
  /// Sets the critical point on the step that the next add_step() passes; no later steps are searched.
  void lose(const PathPoint& critical) { critical_ = critical; }

  /// @brief Sets summary.softest, and, if the ratio falls below 0.1, a warning and the start of the message.
  ///
  /// Without a minimum before the critical point, that point is the softest.
  /// @pre result.summary has its final critical load and message
  void report(const Structure& structure, const Analysis& analysis, Result& result) const;

 private:
  /// Finds a local minimum of the stiffness between two path points.
  void search(PathPoint low, PathPoint high);
  /// Finds a local minimum on a step at whose ends the stiffness falls.
  void search_before_fall(const PathPoint& from, const PathPoint& to);
  /// Finds a local minimum between a point and the critical point, where the stiffness is zero.
  void search_before_critical(PathPoint from);

  PointSolver& solver_;
  double unloaded_ = 0.0;  ///< least stiffness of the unloaded structure; 0: unknown
  std::optional<PathPoint> critical_;
  bool ended_ = false;
  /// Lowest minimum so far, with its modes; final once the ratio is below 0.1.
  std::optional<PathPoint> lowest_;
};

/// @brief Largest displacement, rotation and strain of a state, for Summary::at_critical.
/// @param y scaled unknowns
[[nodiscard]] AtCritical at_critical(const Structure& structure, const Eigen::VectorXd& y);

}  // namespace snapthrough
