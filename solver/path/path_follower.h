#pragma once
/// @file
/// Follows an equilibrium path step by step: pseudo-arc-length continuation with step control.

#include "solver/model/analysis.h"
#include "solver/path/path_start.h"
#include "solver/path/point_solver.h"
#include "solver/path/predictor.h"
#include "solver/path/step_test.h"

namespace snapthrough {

/// Thresholds of the steps and of the corrector.
struct PathOptions {
  StepLimits step;
  CorrectorOptions corrector;
};

/// @brief What a step met. `kinked`: the path turns sharply at the step's start, because a support begins or
/// ceases to act there, and the step leads on in the new direction.
enum class StepOutcome { advanced, kinked, step_underflow };

/// @brief Takes accepted steps along F(y, lambda) = 0: predicts, corrects, judges (judge_step()), shortens,
/// or goes round a kink. The caller keeps the points and the step size.
class PathFollower {
 public:
  /// @param problem kept by reference
  explicit PathFollower(EquilibriumProblem& problem, const PathOptions& options = {});

  [[nodiscard]] PointSolver& solver() { return solver_; }
  [[nodiscard]] const PointSolver& solver() const { return solver_; }
  [[nodiscard]] PathNorm& norm() { return solver_.norm(); }
  [[nodiscard]] const PathNorm& norm() const { return solver_.norm(); }
  [[nodiscard]] EquilibriumProblem& problem() const { return solver_.problem(); }
  /// Options as they are now, for a follower on another mesh; see limit_steps().
  [[nodiscard]] PathOptions options() const { return {limits_, solver_.options()}; }
  [[nodiscard]] const PathStatistics& statistics() const { return solver_.statistics(); }

  /// @brief One accepted step from `from`: `step.wanted` is tried first, then smaller sizes; sets both
  /// fields.
  [[nodiscard]] StepOutcome step(const PathPoint& from, StepSize& step, PathPoint& to);
  /// @brief Takes the last step back, because its end is not on the same path or not where it should be: the
  /// next one will be shorter.
  void reject(StepSize& step);
  /// @brief The accepted step before -> from is remembered for the prediction of the next one. To be called
  /// only where the path does not turn sharply between the points.
  void remember(const PathPoint& before, const PathPoint& from);
  /// The next step is predicted by its tangent.
  void reset_predictor() { predictor_.reset(); }
  /// @brief The last point before a kink that is within `size` of `from`.
  [[nodiscard]] PathPoint last_point_before_kink(const PathPoint& from, double size);
  /// @brief Bounds the step sizes from now on by the caller's, which are fractions of the load scale.
  /// @param load_rate d lambda / ds at the start, positive
  void limit_steps(const StepOptions& steps, double load_rate);
  /// @brief Lowers the weight of the load in the path's norm where the load dwarfs the displacement: a
  /// structure that carries far more than its members' scale says would meet its limit load as a kink.
  /// @param to_limit whether the path is on the way to a limit. A path that is followed for its own sake
  /// would go on by smaller steps; there the weight changes only where steps have shrunk to the share of a
  /// kink (a thin member between immovable ends turns within gradients that the norm did not see) and where
  /// supports act on one side only (contact changes with displacements that the norm would not see)
  /// @param point to go on from; its tangent is normalised again
  void reweigh_load(bool to_limit, PathPoint& point, StepSize& step);

 private:
  StepOutcome complete(StepOutcome outcome, const StepSize& size, StepSize& step);

  PointSolver solver_;
  StepLimits limits_;
  Predictor predictor_;
  bool took_full_step_ = false;  ///< the last step was accepted at its first size
  double last_full_step_ = 0.0;  ///< remembered size of steps that were accepted at their first size
};

}  // namespace snapthrough
