#pragma once
/// @file
/// One attempt at a step: predicted, corrected, measured.

#include "solver/path/path_point.h"
#include "solver/path/point_solver.h"
#include "solver/path/predictor.h"
#include "solver/path/step_test.h"

namespace snapthrough {

/// What an attempt at a step needs to know.
struct StepAttempt {
  const PathPoint& from;
  StepSizes sizes;
  bool forecast = false;  ///< contact at the end is forecast, not read from the predicted displacement
};

/// @brief Predicts and corrects the end of a step and measures it.
/// @param to its context is the caller's; the rest is set where the corrector converges
[[nodiscard]] StepMeasures try_step(PointSolver& solver, Predictor& predictor, const StepLimits& limits,
                                    const StepAttempt& attempt, PathPoint& to);

}  // namespace snapthrough
