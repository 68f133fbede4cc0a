#pragma once
/// @file
/// A piece of a path between two of its points.

#include <memory>
#include <optional>

#include "solver/path/point_solver.h"

namespace snapthrough {

/// @brief Two points of a path and a unit direction, along which places between them are measured: a place is
/// the plane normal to the direction, given by its fraction (0 to 1) of the length between the points.
class Segment {
 public:
  /// Which unit direction leads from one point to the other.
  enum class Measure {
    path_norm,    ///< the straight line in (y, lambda)
    displacement  ///< the displacement alone, where the load turns within one that the path's norm can't see
  };
  /// @param from, to kept by reference, as in the other functions
  Segment(PointSolver& solver, const PathPoint& from, const PathPoint& to,
          Measure measure = Measure::path_norm);
  /// @param direction unit vector in (y, lambda)
  Segment(PointSolver& solver, const PathPoint& from, const PathPoint& to, Eigen::VectorXd direction,
          double direction_lambda);
  /// @brief A piece of this segment, with the same direction.
  [[nodiscard]] Segment part(const PathPoint& from, const PathPoint& to) const;

  [[nodiscard]] const PathPoint& from() const { return *from_; }
  [[nodiscard]] const PathPoint& to() const { return *to_; }
  [[nodiscard]] const PointSolver& solver() const { return solver_; }
  [[nodiscard]] const Eigen::VectorXd& direction() const { return direction_->y; }
  [[nodiscard]] double direction_lambda() const { return direction_->lambda; }
  [[nodiscard]] bool by_displacement() const { return direction_->by_displacement; }

  /// Distance of the ends along the direction.
  [[nodiscard]] double length() const { return length_to(*to_); }
  /// Distance of a point from the first end along the direction.
  [[nodiscard]] double length_to(const PathPoint& point) const;
  /// Distance of the ends in all directions; without the load where places are measured by displacement.
  [[nodiscard]] double distance() const;
  /// Rate of the load at a point by length along the direction.
  [[nodiscard]] double load_rate(const PathPoint& point) const;
  /// Cosine of a point's tangent with the direction.
  [[nodiscard]] double cosine(const PathPoint& point) const;
  /// @brief Estimates the path at a fraction: by the cubic through both points and tangents, or linearly
  /// where a tangent turns away from the direction. Sets y and lambda only.
  void interpolate(double fraction, PathPoint& point) const;
  /// @brief The point of the path at a fraction, with its tangent and inertia.
  /// @return empty when the correction failed
  [[nodiscard]] std::optional<PathPoint> point_at(double fraction) const;
  /// @brief The point of the path in the plane of a guess.
  /// @param guess y and lambda near the path
  [[nodiscard]] std::optional<PathPoint> point_near(PathPoint guess) const;

 private:
  struct Direction {
    Eigen::VectorXd y;
    double lambda = 0.0;
    bool by_displacement = false;
  };

  PointSolver& solver_;
  const PathPoint* from_;
  const PathPoint* to_;
  std::shared_ptr<const Direction> direction_;
};

}  // namespace snapthrough
