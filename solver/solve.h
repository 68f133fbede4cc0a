#pragma once
/// @file
/// The facade of the solver: request in, result out.

#include <functional>
#include <stop_token>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/check.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// Where a running analysis stands.
struct Progress {
  int branch = 0;
  int step = 0;
  double load_factor = 0.0;
  int negative_eigenvalues = 0;
};

/// A point of a path that was traced, as Branch has it.
struct TracedPoint {
  int branch = 0;
  int step = 0;  ///< along the branch, from 0
  double load_factor = 0.0;
  double arc_length = 0.0;
  int negative_eigenvalues = 0;
  std::vector<NamedValue> monitors;
};

/// What a caller may watch or stop. The functions are called from the solving thread: `on_point` and then
/// `on_progress` at each accepted step, `on_critical` when a critical point was located, with its load on the
/// path's own mesh. What finer meshes make of that load, and its error estimate, come with the result.
struct Hooks {
  std::stop_token stop;
  std::function<void(const Progress&)> on_progress = {};
  std::function<void(const CriticalPoint&)> on_critical = {};
  std::function<void(const TracedPoint&)> on_point = {};
};

/// @brief Runs one analysis.
/// @pre check(model, analysis) is empty; otherwise throws std::invalid_argument.
/// @return The result; a numerical failure is in Result::failure together with what was reached.
/// Thread safety: reentrant, shares nothing. Deterministic: the same request gives bit-identical results.
[[nodiscard]] Result solve(const Model& model, const Analysis& analysis, const Hooks& hooks = {});

/// @brief The same for a request that check() has passed already, without checking it again.
/// @pre check(model, analysis) is empty; otherwise undefined.
[[nodiscard]] Result solve_checked(const Model& model, const Analysis& analysis, const Hooks& hooks = {});

}  // namespace snapthrough
