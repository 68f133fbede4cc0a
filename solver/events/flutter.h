#pragma once
/// @file
/// Flutter: places of a path where two natural frequencies meet and become complex.

#include <Eigen/Core>
#include <optional>

#include "solver/discrete/mass_matrix.h"
#include "solver/events/critical_event.h"
#include "solver/events/damped_motions.h"
#include "solver/events/natural_motions.h"
#include "solver/events/root_finder.h"
#include "solver/path/point_solver.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// What natural motions, or the determinant, tell of a step between two points of a path.
struct StepVibrations {
  std::optional<CriticalEvent> flutter;  ///< the first place at which a pair begins to flutter
  /// The step is too long: stability is lost and regained by divergence between its ends, whose inertia does
  /// not show it (only the parity of the inertia of an unsymmetric tangent is known), or the natural motions
  /// change too much to be followed.
  bool is_too_long = false;
};

/// @brief Looks at places between two points of a path for a determinant of another sign, without masses.
[[nodiscard]] StepVibrations divergence_on_step(PointSolver& solver, const PathPoint& from,
                                                const PathPoint& to);

/// @brief Looks for the beginning of flutter on the steps of one path.
///
/// Loads without a potential make the tangent unsymmetric. Two real eigenvalues mu of J x = mu M x can then
/// meet and leave the real axis: a vibration with growing amplitude, while every static test says stable. The
/// square of the difference of two eigenvalues that meet is a smooth function of the load, and falls through
/// zero there. Damped vibrations flutter where their growth rises through zero, which small damping may bring
/// about at a lower load (Ziegler, 1952).
class FlutterSearch {
 public:
  /// @param structure, model kept by reference; must outlive this object
  /// @pre structure.unsymmetric() and has_mass(model)
  FlutterSearch(const Structure& structure, const Model& model);

  /// @brief Follows the natural motions between two points of a path.
  /// @param tolerance on the load of flutter, relative
  [[nodiscard]] StepVibrations on_step(PointSolver& solver, const PathPoint& from, const PathPoint& to,
                                       double tolerance);

 private:
  struct Sample {
    PathPoint point;
    NaturalMotions motions;
    int pairs = 0;          ///< conjugate pairs of eigenvalues that are not real
    GrowingMotion growing;  ///< damped vibration; not used without damping
  };
  [[nodiscard]] Sample sample(const PathPoint& point);
  [[nodiscard]] std::optional<CriticalEvent> between(PointSolver& solver, const Sample& from,
                                                     const Sample& to, double tolerance, int depth);
  [[nodiscard]] std::optional<CriticalEvent> locate_growth(PointSolver& solver, const Sample& from,
                                                           const Sample& to, double tolerance);
  [[nodiscard]] std::optional<CriticalEvent> locate(PointSolver& solver, const Sample& from, const Sample& to,
                                                    double tolerance);

  [[nodiscard]] std::optional<CriticalEvent> event_at(const LocatedRoot& root, double mean);

  StructuralProblem problem_;
  const Structure& structure_;
  const Model& model_;
  MassMatrix masses_;
  MotionSearch search_;
  MotionSearch left_;  ///< motions of the transposed tangent
  KrylovColumns columns_;
  std::optional<Sample> last_;
  bool too_long_ = false;  ///< the present step, see StepVibrations
};

}  // namespace snapthrough
