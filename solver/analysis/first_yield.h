#pragma once
/// @file
/// First state of a path in which the stress of an outer fibre reaches its strength.

#include <array>
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
  /// Whether stresses are below the strength up to the end of the last step; false before the first one.
  [[nodiscard]] bool is_below() const { return !is_over_ && before_.has_value(); }
  /// @brief Writes what was found: load factor, place and, on a mesh that is chosen by accuracy, the load
  /// factor on meshes as fine as the accuracy asks for, with its error estimate.
  /// @param accurate the path's result is final: the load factor is taken to finer meshes
  void finish(const Analysis& analysis, bool accurate, Result& result);

 private:
  /// A state of the path.
  struct Stressed {
    PathPoint point;
    double excess = 0.0;  ///< largest stress over strength, minus one
  };
  /// The state at first yield, and the utilisation in it.
  struct Found {
    PathPoint state;
    MemberUtilisation at;
    double rate = 0.0;  ///< d size of the utilisation / d lambda
  };
  [[nodiscard]] Stressed stressed(const PathPoint& point) const;
  [[nodiscard]] std::optional<Stressed> first_beyond(const PathPoint& from, const PathPoint& to) const;
  [[nodiscard]] std::optional<PathPoint> on_segment(const Stressed& from, const Stressed& beyond) const;
  [[nodiscard]] std::optional<PathPoint> by_load(Stressed from, Stressed beyond) const;
  void locate(const Stressed& from, const Stressed& beyond);
  [[nodiscard]] double excess(const PathPoint& point) const;
  [[nodiscard]] FirstYield described(const PathPoint& state, const MemberUtilisation& at) const;
  void refine(const Analysis& analysis, FirstYield& yield, Result& result);

  const Structure& structure_;
  PointSolver& solver_;
  std::optional<Found> found_;
  /// Scaled load factors between which first yield lies and was not found; empty: it was, or none is met.
  std::optional<std::array<double, 2>> between_;
  bool is_over_;                  ///< nothing more is looked for
  std::optional<double> before_;  ///< excess at the end of the last step; empty: no step was added
};

}  // namespace snapthrough
