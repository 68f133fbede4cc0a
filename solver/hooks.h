#pragma once
/// @file
/// Observation and cancellation of a running analysis.

#include <functional>
#include <stop_token>
#include <vector>

#include "solver/result.h"

namespace snapthrough {

/// Progress of a running analysis.
struct Progress {
  int branch = 0;
  int step = 0;
  double load_factor = 0.0;
  int negative_eigenvalues = 0;
};

/// Point of a traced path, as in Branch.
struct TracedPoint {
  int branch = 0;
  int step = 0;  ///< index of the step along the branch, from 0
  double load_factor = 0.0;
  double arc_length = 0.0;
  int negative_eigenvalues = 0;
  std::vector<NamedValue> monitors;
};

/// Callbacks and stop token. Functions are called from the solving thread: `on_point`, then `on_progress`, at
/// each accepted step; `on_critical` for each located critical point with its load on the path's mesh (the
/// result adds corrections by finer meshes, and error estimates).
struct Hooks {
  std::stop_token stop;
  std::function<void(const Progress&)> on_progress = {};
  std::function<void(const CriticalPoint&)> on_critical = {};
  std::function<void(const TracedPoint&)> on_point = {};
};

}  // namespace snapthrough
