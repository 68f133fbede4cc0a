#pragma once
/// @file
/// Finds every user mistake in a model and analysis before any numerics.

#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough {

/// One mistake: where (JSON Pointer into the request document), which rule, and a sentence.
struct Finding {
  std::string pointer;  ///< e.g. "/model/members/0/section"
  std::string code;  ///< e.g. "unknown_reference", "out_of_range", "zero_length", "mechanism", "unsupported"
  std::string detail;  ///< one sentence naming the field and the rule
};

/// @brief All mistakes of a request, in document order; empty when it can be solved.
///
/// Checks ids and references, ranges of values, geometry, and (when nothing else is wrong) that the
/// structure, with one-sided supports counted as acting, is not a mechanism. Never throws for a wrong model.
/// Reentrant.
[[nodiscard]] std::vector<Finding> check(const Model& model, const Analysis& analysis);

}  // namespace snapthrough
