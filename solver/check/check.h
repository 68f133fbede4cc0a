#pragma once
/// @file
/// Validation of models and analyses.

#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/finding.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief Finds all mistakes of a request, in document order; empty when the request can be solved.
///
/// Checks ids, references, value ranges and geometry, and, if these are correct, that the structure with all
/// one-sided supports acting is no mechanism. Never throws for an invalid model. Reentrant.
[[nodiscard]] std::vector<Finding> check(const Model& model, const Analysis& analysis);

}  // namespace snapthrough
