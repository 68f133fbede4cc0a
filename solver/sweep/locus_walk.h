#pragma once
/// @file
/// One curve of critical points, step by step.

#include <optional>
#include <stop_token>
#include <vector>

#include "solver/sweep/locus_curve.h"
#include "solver/sweep/locus_point.h"

namespace snapthrough {

/// @brief Two consecutive points of a curve and the curve between them. A place is the plane normal to the
/// first point's direction at a distance from it.
class LocusPiece {
 public:
  /// @param from, to kept by reference
  LocusPiece(const LocusMetric& metric, const LocusPoint& from, const LocusPoint& to);
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const LocusPoint& from() const { return from_; }
  [[nodiscard]] const LocusPoint& to() const { return to_; }
  /// Cubic through both points with both directions.
  [[nodiscard]] LocusPoint interpolated(double s) const;

 private:
  const LocusMetric& metric_;
  const LocusPoint& from_;
  const LocusPoint& to_;
  double length_ = 0.0;
  double cosine_ = 1.0;  ///< cosine of the angle between both directions
};

/// Follows one curve from a point at the first or the last value.
class LocusWalk {
 public:
  /// @param family, metric, counts kept by reference
  /// @param coordinates of the values
  /// @param load_scale scaled load factor over load factor
  LocusWalk(const ModelFamily& family, const LocusMetric& metric, const std::vector<double>& coordinates,
            double load_scale, const LocusOptions& options, LocusCounts& counts)
      : family_(family),
        metric_(metric),
        coordinates_(coordinates),
        load_scale_(load_scale),
        options_(options),
        solver_(family, metric, counts) {}

  /// @brief Follows the curve from a point, whose index among the values is given, towards the other values.
  /// @param point guess of the critical point; its null motion is set
  /// @param steps incremented by the number of accepted steps
  /// @return empty: the point is not found
  [[nodiscard]] std::optional<LocusCurve> run(LocusPoint point, std::size_t index,
                                              const std::stop_token& stop, int& steps);

 private:
  struct Special {
    LocusEventType type;
    LocusPoint point;
  };
  [[nodiscard]] std::optional<LocusPoint> advance(const LocusPoint& from, double& step);
  [[nodiscard]] std::optional<LocusPoint> at_bound(const LocusPoint& from, double bound);
  [[nodiscard]] std::optional<LocusPoint> point_at(const LocusPiece& piece, double s);
  [[nodiscard]] std::vector<Special> special_points(const LocusPoint& from, const LocusPoint& to);
  template <class Function>
  [[nodiscard]] std::optional<LocusPoint> locate(const LocusPiece& piece, double at_from, double at_to,
                                                 const Function& function);
  [[nodiscard]] double other_stiffness(LocusPoint point);
  void add_piece(const LocusPoint& from, const LocusPoint& to, LocusCurve& curve);
  void add_values(const LocusPoint& from, const LocusPoint& to, LocusCurve& curve);
  [[nodiscard]] std::optional<LocusPoint> at_value(const LocusPiece& piece, double t);
  void add_load(std::size_t index, const LocusPoint& point, LocusCurve& curve) const;

  const ModelFamily& family_;
  const LocusMetric& metric_;
  const std::vector<double>& coordinates_;
  double load_scale_;
  LocusOptions options_;
  LocusSolver solver_;
};

}  // namespace snapthrough
