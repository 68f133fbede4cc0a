#pragma once
/// @file
/// What a caller may watch of a running analysis, and how it is stopped.

#include <functional>
#include <stop_token>
#include <vector>

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

}  // namespace snapthrough
