#pragma once
/// @file
/// Flutter: places of a path where two natural frequencies meet and become complex.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/discrete/mass_matrix.h"
#include "solver/events/critical_event.h"
#include "solver/events/damped_motions.h"
#include "solver/events/massless.h"
#include "solver/events/natural_motions.h"
#include "solver/events/root_finder.h"
#include "solver/path/point_solver.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// What natural motions, or the determinant, tell of a step between two points of a path.
struct StepVibrations {
  /// The first place at which a vibration begins to grow: a pair begins to flutter, or a frequency becomes
  /// infinite (MasslessSearch).
  std::optional<CriticalEvent> loss;
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
///
/// Each connected part of the structure on which such loads act is searched by itself, among the motions that
/// the forces at the places of its loads excite (follower_parts()).
class FlutterSearch {
 public:
  /// @param structure kept by reference; must outlive this object
  /// @param stage actions that the load factor multiplies
  /// @pre structure.traits.has_mass, and not structure.traits.symmetric
  explicit FlutterSearch(const Structure& structure,
                         StructuralProblem::Stage stage = StructuralProblem::Stage::proportional);

  /// @brief Follows the natural motions between two points of a path.
  ///
  /// Where one-sided supports touch without pressure at `from`, as where a path begins, natural motions jump:
  /// they are compared from the first point of the step on at which these supports act or are left.
  /// @param tolerance on the load of flutter, relative
  [[nodiscard]] StepVibrations on_step(PointSolver& solver, const PathPoint& from, const PathPoint& to,
                                       double tolerance);
  /// Whether a vibration about an equilibrium grows and oscillates.
  [[nodiscard]] bool flutters_at(const PathPoint& point);

 private:
  struct Sample {
    PathPoint point;
    NaturalMotions motions;
    int pairs = 0;          ///< conjugate pairs of eigenvalues that are not real
    GrowingMotion growing;  ///< damped vibration; not used without damping
  };
  /// Search in one connected part of the structure.
  struct Part {
    MotionSearch search;
    MotionSearch left;  ///< motions of the transposed tangent
    std::optional<Sample> last;
  };
  [[nodiscard]] Sample sample(Part& part, const PathPoint& point);
  [[nodiscard]] bool grows(const Sample& at) const;
  [[nodiscard]] double largest_square() const;
  [[nodiscard]] PathPoint beginning(PointSolver& solver, const PathPoint& from, const PathPoint& to) const;
  [[nodiscard]] std::optional<CriticalEvent> in_part(Part& part, PointSolver& solver, const PathPoint& from,
                                                     const PathPoint& to, double tolerance);
  [[nodiscard]] std::optional<CriticalEvent> between(Part& part, PointSolver& solver, const Sample& from,
                                                     const Sample& to, double tolerance);
  [[nodiscard]] std::optional<CriticalEvent> on_piece(Part& part, PointSolver& solver, const Sample& from,
                                                      const Sample& to, double tolerance);
  [[nodiscard]] std::optional<CriticalEvent> locate_growth(Part& part, PointSolver& solver,
                                                           const Sample& from, const Sample& to,
                                                           double tolerance);
  [[nodiscard]] std::optional<CriticalEvent> locate(Part& part, PointSolver& solver, const Sample& from,
                                                    const Sample& to, double tolerance);
  [[nodiscard]] std::optional<CriticalEvent> event_at(Part& part, const LocatedRoot& root, double mean);

  StructuralProblem problem_;
  const Structure& structure_;
  const ResolvedModel& model_;
  MassMatrix masses_;
  KrylovColumns columns_;
  std::vector<Part> parts_;
  std::optional<MasslessSearch> massless_;  ///< where some element has no mass
  int halvings_ = 0;                        ///< halvings of the present step
  bool too_long_ = false;                   ///< the present step, see StepVibrations
};

}  // namespace snapthrough
