#pragma once
/// @file
/// Entry point of the solver: request in, result out.

#include "solver/check/check.h"
#include "solver/hooks.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Runs one analysis.
/// @pre check(model, analysis) is empty; otherwise throws std::invalid_argument.
/// @return the result; a numerical failure is in Result::failure, with everything that was reached
/// Thread safety: reentrant, shares nothing. Deterministic: the same request gives bit-identical results.
[[nodiscard]] Result solve(const Model& model, const Analysis& analysis, const Hooks& hooks = {});

/// @brief Runs one analysis that has already passed check(), without checking it again.
/// @pre check(model, analysis) is empty; otherwise undefined.
[[nodiscard]] Result solve_checked(const Model& model, const Analysis& analysis, const Hooks& hooks = {});

}  // namespace snapthrough
