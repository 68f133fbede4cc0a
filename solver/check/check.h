#pragma once
/// @file
/// Finds every user mistake in a model and analysis before any numerics.

#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/finding.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief All mistakes of a request, in document order; empty when it can be solved.
///
/// Checks ids and references, ranges of values, geometry, and (when nothing else is wrong) that the
/// structure, with one-sided supports counted as acting, is not a mechanism. Never throws for a wrong model.
/// Reentrant.
[[nodiscard]] std::vector<Finding> check(const Model& model, const Analysis& analysis);

}  // namespace snapthrough
