#pragma once
/// @file
/// One point of a sweep, from its request document to its outputs.

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <vector>

#include "api/sweep.h"
#include "server/jobs/job.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// What runs one analysis: snapthrough::solve, or a test's stand-in. Must be reentrant.
using SolveFunction = std::function<Result(const Model&, const Analysis&, const Hooks&)>;

/// The code of a failure where memory could not be had.
inline constexpr const char* kOutOfMemory = "out_of_memory";

/// The exception that is being handled as a failure ("internal_error", or kOutOfMemory).
[[nodiscard]] JobFailure mishap_now();

/// @brief Solves a point, given its document (Sweep::document_at()). Whatever goes wrong is an outcome: a
/// document that is no valid request ("wrong_request"), an analysis that fails (its code), and mishap_now().
/// Asked to stop, it is "cancelled". Thread-safe if `solve` is.
[[nodiscard]] api::PointOutcome solve_point(const api::Sweep& sweep,
                                            const std::shared_ptr<const nlohmann::json>& document,
                                            const SolveFunction& solve, const Hooks& hooks);

/// @brief The outcomes of the `block()` points from `first` on, which is a multiple of it, by following the
/// critical point along the last parameter (solver/sweep/critical_curve.h). A point whose document is no
/// valid request is left out of the curve. Thread-safe. @pre sweep.follows()
[[nodiscard]] std::vector<api::PointOutcome> solve_curve(const api::Sweep& sweep, std::uint64_t first,
                                                         const std::stop_token& stop);

}  // namespace snapthrough::server
