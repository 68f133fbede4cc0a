#pragma once
/// @file
/// One point of a sweep, from its request document to its outputs.

#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "api/sweep.h"
#include "server/worker/pool.h"

namespace snapthrough::server {

/// @brief Solves a point, given its document (Sweep::document_at()). Whatever goes wrong is an outcome: a
/// document that is no valid request
/// ("wrong_request"), an analysis that fails (its code), an exception ("internal_error"), memory
/// ("out_of_memory"). Asked to stop, it is "cancelled". Thread-safe if `solve` is.
[[nodiscard]] api::PointOutcome solve_point(const api::Sweep& sweep,
                                            const std::shared_ptr<const nlohmann::json>& document,
                                            const SolveFunction& solve, const Hooks& hooks);

}  // namespace snapthrough::server
