#pragma once
/// @file
/// Checks of a whole result: every state's equations, inertia, contact, and how the points follow each other.

#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough::testing {

/// What the checks of one result came to.
struct ResultCheck {
  int points = 0;          ///< states whose equations were evaluated
  int uncovered = 0;       ///< states whose shape could not be rebuilt (mode imperfections, tiny elements)
  double residual = 0.0;   ///< worst equation over its tolerance
  int inertia = 0;         ///< states whose inertia was counted
  int undecided = 0;       ///< of these, with an eigenvalue lost in rounding
  double imbalance = 0.0;  ///< worst sum of reactions, springs, bases and loads, of the largest
  double stretch = 0.0;    ///< largest distance of two neighbours over the arc length between them
  std::vector<std::string> failures;
};

/// Points per member that the checks need of `analysis.output` (with `states: all`); 0: not coverable.
/// @param told of a path after the first, whose mesh is not known before it was followed
[[nodiscard]] int points_needed(const Model& model, const Analysis& analysis, const MeshReport& told = {});

[[nodiscard]] ResultCheck check_result(const Model& model, const Analysis& analysis, const Result& result);

}  // namespace snapthrough::testing
