#pragma once
/// @file
/// First state of a path in which the stress of an outer fibre reaches its strength.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/path/point_solver.h"
#include "solver/report/strength.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Looks along a path, step by step, for the first state in which stress reaches strength.
///
/// A model without strengths costs nothing. The largest stress of the end of each step is searched for along
/// the members, and that of states between its ends where one of both is near first yield.
class FirstYieldSearch {
 public:
  /// @param structure, solver kept by reference; must outlive this object
  FirstYieldSearch(const Structure& structure, PointSolver& solver)
      : structure_(structure), solver_(solver), is_over_(!has_strength(*structure.model)) {}

  /// Looks on a step of the path, until a state is found. The path's first state may be beyond first yield.
  void add_step(const PathPoint& from, const PathPoint& to);
  /// @brief Writes what was found: load factor, place and, on a mesh that is chosen by accuracy, the load
  /// factor on meshes as fine as the accuracy asks for, with its error estimate.
  /// @param accurate the path's result is final: the load factor is taken to finer meshes
  void finish(const Analysis& analysis, bool accurate, Result& result);

 private:
  /// The state at first yield, and the utilisation in it.
  struct Found {
    PathPoint state;
    MemberUtilisation at;
    double rate = 0.0;  ///< d size of the utilisation / d lambda
  };
  [[nodiscard]] std::optional<PathPoint> first_beyond(const PathPoint& from, const PathPoint& to);
  [[nodiscard]] std::optional<PathPoint> on_segment(const PathPoint& from, const PathPoint& beyond) const;
  [[nodiscard]] std::optional<PathPoint> by_load(PathPoint from, PathPoint beyond) const;
  void locate(const PathPoint& from, const PathPoint& beyond);
  [[nodiscard]] double excess(const PathPoint& point) const;
  [[nodiscard]] FirstYield described(const PathPoint& state, const MemberUtilisation& at) const;
  void refine(const Analysis& analysis, FirstYield& yield, Result& result);

  const Structure& structure_;
  PointSolver& solver_;
  std::optional<Found> found_;
  bool is_over_;                  ///< nothing more is looked for
  std::optional<double> before_;  ///< excess at the end of the last step; empty: no step was added
};

}  // namespace snapthrough
