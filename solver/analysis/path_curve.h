#pragma once
/// @file
/// The curves of a load factor over shown values, as cubics between computed points of a path.

#include <Eigen/Core>
#include <optional>
#include <stop_token>
#include <vector>

#include "solver/analysis/path_row.h"
#include "solver/path/point_solver.h"

namespace snapthrough {

/// A part of a curve: what lies beyond one arc length, up to another one.
struct CurvePart {
  double beyond = 0.0;
  double to = 0.0;
};

/// @brief Piecewise cubic curve through computed points of a path and their tangents, by arc length.
///
/// Distances are measured in the planes of the load factor over each shown value, both over their ranges
/// (over the arc length where nothing is shown).
class PathCurve {
 public:
  /// @param points two or more in path order, each with its tangent of norm one
  /// @param range is extended by the points; distances are measured over it
  PathCurve(PointSolver& solver, const ShownValues& shown, std::vector<PathPoint> points, ShownRange& range);

  /// @brief In a part of the curve, corrects points between others until the estimated error of the cubics is
  /// small enough.
  /// @return number of cubics that may be too far off for straight lines, where no point could be corrected
  [[nodiscard]] int refine(const CurvePart& part, const std::stop_token& stop);

  /// @brief Visits the rows of a part of the curve: its points, and between them as many points of the cubics
  /// as straight lines need.
  /// @param passed further points on the curve, in path order; their tangents are set to the cubics'
  void rows(const CurvePart& part, std::vector<PathPoint>& passed, const RowVisitor& visit) const;

 private:
  /// A computed point and what is drawn of it.
  struct Node {
    PathPoint point;
    Eigen::VectorXd value;  ///< arc length or load factor first, then the shown values, over their ranges
    Eigen::VectorXd rate;   ///< rates of the values by arc length
    double per_arc = 1.0;   ///< length of a step along the tangent by arc length
    int halvings = 0;       ///< how often the piece beyond this point was halved
  };
  /// A place on the piece beyond a node, as a fraction of its arc length.
  struct Place {
    std::size_t node = 0;
    double fraction = 0.0;
  };

  [[nodiscard]] double length(std::size_t piece) const {
    return nodes_[piece + 1].point.arc_length - nodes_[piece].point.arc_length;
  }
  [[nodiscard]] Eigen::VectorXd values_of(const PathPoint& point) const;
  void set_node(Node& node) const;
  void set_ranges(const ShownValues& shown, ShownRange& range);
  void set_rate(PathPoint& point) const;
  [[nodiscard]] Eigen::VectorXd third(std::size_t piece) const;
  [[nodiscard]] Eigen::VectorXd value_at(const Place& place) const;
  [[nodiscard]] double beyond_ends(std::size_t piece, const Eigen::VectorXd& offset) const;
  [[nodiscard]] double error(std::size_t piece) const;
  [[nodiscard]] bool split(std::size_t piece);
  [[nodiscard]] std::optional<double> meeting_place(std::size_t piece) const;
  [[nodiscard]] std::optional<PathPoint> point_between(std::size_t piece) const;
  [[nodiscard]] PathPoint point_at(const Place& place) const;
  void add_between(std::size_t piece, double from, double to, int depth,
                   std::vector<double>& fractions) const;

  PointSolver& solver_;
  const ShownValues& shown_;
  Eigen::VectorXd ranges_;  ///< infinite for what does not move
  std::vector<Node> nodes_;
};

}  // namespace snapthrough
