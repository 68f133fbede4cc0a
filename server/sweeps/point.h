#pragma once
/// @file
/// One point of a sweep, from its request document to its outputs.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <vector>

#include "api/sweep.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {

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
