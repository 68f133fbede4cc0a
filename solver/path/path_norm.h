#pragma once
/// @file
/// The norm in which steps, distances and angles of an equilibrium path are measured.

#include <Eigen/Core>

#include "solver/newton/corrector.h"
#include "solver/path/path_point.h"

namespace snapthrough {

/// @brief Displacement gradients (root mean square over the members, dimensionless) that path following
/// compares displacements with. Source: geometry of the exact beam theory, where gradients are rotations and
/// strains.
struct Gradients {
  /// A rotation of 17 degrees: the structure has another shape.
  static constexpr double large = 0.3;
  /// The least displacement that one load scale counts for in the norm, so that the load of a straight column
  /// is seen although the column hardly moves before it buckles.
  static constexpr double small = 0.003;
  /// A displacement whose square is near rounding (1e-14): size of the first step where supports act on one
  /// side only, and least distance of two points whose correction rounding decides.
  static constexpr double tiny = 1e-7;
};

/// @brief Norm of (dy, dlambda): sqrt(dy.W dy + w dlambda^2), with W the problem's metric and w the weight of
/// the load. Arc lengths keep the weight of the path's start; distances and angles use the current weight.
class PathNorm {
 public:
  /// @param weights diagonal of W; kept by reference
  explicit PathNorm(const Eigen::VectorXd& weights) : metric_{&weights, 1.0} {}

  [[nodiscard]] const PathMetric& metric() const { return metric_; }
  [[nodiscard]] double distance(const PathPoint& a, const PathPoint& b) const;
  /// Angle between the tangents of two points, rad.
  [[nodiscard]] double angle(const PathPoint& a, const PathPoint& b) const;
  /// Distance of two points with the load's weight at the path's start: the difference of their arc lengths.
  [[nodiscard]] double arc(const PathPoint& a, const PathPoint& b) const;
  /// Arc length by length of a step along the tangent of a point.
  [[nodiscard]] double arc_per_step(const PathPoint& point) const;
  /// Length scale for searches near a point: min(arc length, norm of the point, Gradients::large).
  [[nodiscard]] double search_scale(const PathPoint& point) const;

  /// Estimate of the first critical load factor, by which the load is measured.
  [[nodiscard]] double load_scale() const { return load_scale_; }
  /// Smallest load factor that tolerances on loads are relative to.
  [[nodiscard]] double least_load() const { return 1e-6 * load_scale_; }
  /// Load factor at which a path is given up: far above the buckling load of the weakest member, and above
  /// the one of the strongest member on its foundations.
  [[nodiscard]] double load_bound() const { return load_bound_; }

  /// Measures displacements alone, until set_scales() is called.
  void ignore_load() { metric_.load_weight = 0.0; }
  /// @brief Sets the scales and the weight of the load from the response to a unit load at the path's start.
  void set_scales(const EquilibriumProblem& problem, const Eigen::VectorXd& response);
  /// Takes over scales and weights from a norm of the same structure on another mesh.
  void adopt(const PathNorm& other);
  /// Multiplies the weight of the load by `factor` squared; arc lengths stay as they are.
  void reweigh(double factor) { metric_.load_weight *= factor * factor; }

 private:
  PathMetric metric_;
  double arc_load_weight_ = 1.0;  ///< weight of the load in arc lengths
  double load_scale_ = 1.0;
  double load_bound_ = 1.0;
};

}  // namespace snapthrough
