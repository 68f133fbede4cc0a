#pragma once
/// @file
/// Critical points of a coarser mesh, located on a finer one.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/path/path_follower.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// Numbers of the search for a known critical point. Chosen; half and double of them change no answer
/// (docs/theory.md).
struct PolishLimits {
  /// Range on either side of the point, over the length of the path so far (PathNorm::search_scale()).
  static constexpr double reach = 0.02;
  /// Factor on `reach` for Newton's method, and for the search that follows when that within `reach` fails.
  static constexpr double widening = 6.0;
  /// Most Newton iterations: they converge slowly where a foundation is stiffer on the finer mesh.
  static constexpr int corrections = 40;
  static constexpr int steps = 12;  ///< most steps along the path from the preceding point
};

/// Critical point on a mesh.
struct FoundPoint {
  CriticalEvent event;
  PathPoint equilibrium;  ///< the point in equilibrium, or a neighbouring equilibrium in its place
};

/// Finer mesh of a model, with the path follower on it.
class FineMesh {
 public:
  /// @param measure follower that has started on a coarser mesh; its norm and load scale are used here
  /// @param tolerance relative load factor tolerance of located points
  FineMesh(Structure structure, const PathFollower& measure, double tolerance);

  [[nodiscard]] const Structure& structure() const { return structure_; }
  [[nodiscard]] EquilibriumProblem& problem() { return problem_; }
  [[nodiscard]] const PathNorm& norm() const { return follower_.norm(); }
  [[nodiscard]] const PathStatistics& statistics() const { return follower_.statistics(); }

  /// @brief Locates the critical point that corresponds to one of a coarser mesh: same type, same inertia on
  /// both sides, nearest load.
  ///
  /// The path is corrected on both sides of the known point and searched in between; if that fails, in a
  /// wider range; at last the path is followed from the preceding path point, as on the coarse mesh.
  /// @param from structure of `known`
  /// @param before point of the coarse path before `known`, without critical points in between
  /// @param base structure of `before`
  /// @return empty when no such point is near
  [[nodiscard]] std::optional<FoundPoint> find(const Structure& from, const CriticalEvent& known,
                                               const Structure& base, const PathPoint& before);
  /// @brief The bifurcation of this mesh that belongs to one of a coarser mesh, by Newton's method alone.
  /// @pre known.null is set
  [[nodiscard]] std::optional<CriticalEvent> bifurcation(const Structure& from, const CriticalEvent& known);
  /// @brief Whether this mesh has an equilibrium with the same inertia near a point of a coarser mesh.
  [[nodiscard]] bool has(const Structure& from, const PathPoint& point);

 private:
  /// @param[in,out] motions columns of the structure `from`, then of this one
  [[nodiscard]] PathPoint transferred(const Structure& from, const PathPoint& point,
                                      Eigen::MatrixXd& motions) const;
  [[nodiscard]] std::optional<PathPoint> corrected(const PathPoint& guess, double along, double reach);
  [[nodiscard]] std::optional<CriticalEvent> by_newton(const CriticalEvent& known, const PathPoint& at,
                                                       Eigen::MatrixXd null);
  [[nodiscard]] std::optional<FoundPoint> near(const CriticalEvent& known, const PathPoint& at, double reach);
  [[nodiscard]] std::optional<FoundPoint> growth_near(const CriticalEvent& known, const PathPoint& at,
                                                      double reach);
  [[nodiscard]] std::optional<FoundPoint> follow(const CriticalEvent& known, const PathPoint& before,
                                                 double distance);

  Structure structure_;
  StructuralProblem problem_;
  PathFollower follower_;
  double tolerance_;
};

}  // namespace snapthrough
