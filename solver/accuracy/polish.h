#pragma once
/// @file
/// A critical point that is known on one mesh, found on a finer one.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/path/path_follower.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// A critical point of a mesh.
struct FoundPoint {
  CriticalEvent event;
  PathPoint equilibrium;  ///< the point itself, or one so near that it stands for it, in equilibrium
};

/// A finer mesh of a model and the path follower on it.
class FineMesh {
 public:
  /// @param measure a follower that has started on a coarser mesh: its norm and load scale are used here
  /// @param tolerance of located points, relative in the load factor
  FineMesh(Structure structure, const PathFollower& measure, double tolerance);

  [[nodiscard]] const Structure& structure() const { return structure_; }
  [[nodiscard]] EquilibriumProblem& problem() { return problem_; }
  [[nodiscard]] const PathStatistics& statistics() const { return follower_.statistics(); }

  /// @brief The critical point of this mesh that belongs to one of a coarser mesh: of the same type, with the
  /// same inertia on both sides, the nearest by load.
  ///
  /// The path is corrected on both sides of the known point and searched between; if nothing was found,
  /// wider; at last it is followed from the path's point before the critical one, as the coarse path was.
  /// @param before a point of the coarse path before the critical one, from which nothing else is in between
  /// @param base where `before` is from; `from` where `known` is from
  /// @return empty when there is no such point nearby
  [[nodiscard]] std::optional<FoundPoint> find(const Structure& from, const CriticalEvent& known,
                                               const Structure& base, const PathPoint& before);
  /// @brief The bifurcation of this mesh that belongs to one of a coarser mesh, by Newton's method alone.
  /// @pre known.null
  [[nodiscard]] std::optional<CriticalEvent> bifurcation(const Structure& from, const CriticalEvent& known);
  /// @brief Whether this mesh has an equilibrium near a point of a coarser one, with the same inertia.
  [[nodiscard]] bool has(const Structure& from, const PathPoint& point);

 private:
  [[nodiscard]] PathPoint transferred(const Structure& from, const PathPoint& point) const;
  [[nodiscard]] std::optional<PathPoint> corrected(const PathPoint& guess, double along, double reach);
  [[nodiscard]] std::optional<CriticalEvent> by_newton(const Structure& from, const CriticalEvent& known,
                                                       const PathPoint& at);
  [[nodiscard]] std::optional<FoundPoint> near(const CriticalEvent& known, const PathPoint& at, double reach);
  [[nodiscard]] std::optional<FoundPoint> follow(const CriticalEvent& known, const PathPoint& before,
                                                 double distance);

  Structure structure_;
  StructuralProblem problem_;
  PathFollower follower_;
  double tolerance_;
};

}  // namespace snapthrough
