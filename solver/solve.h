#pragma once
/// @file
/// The facade of the solver: request in, result out.

#include "solver/check/check.h"
#include "solver/hooks.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Runs one analysis.
/// @pre check(model, analysis) is empty; otherwise throws std::invalid_argument.
/// @return The result; a numerical failure is in Result::failure together with what was reached.
/// Thread safety: reentrant, shares nothing. Deterministic: the same request gives bit-identical results.
[[nodiscard]] Result solve(const Model& model, const Analysis& analysis, const Hooks& hooks = {});

/// @brief The same for a request that check() has passed already, without checking it again.
/// @pre check(model, analysis) is empty; otherwise undefined.
[[nodiscard]] Result solve_checked(const Model& model, const Analysis& analysis, const Hooks& hooks = {});

}  // namespace snapthrough
