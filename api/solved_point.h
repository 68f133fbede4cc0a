#pragma once
/// @file
/// Solves one point of a sweep.

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "api/point_outcome.h"
#include "api/sweep.h"
#include "solver/hooks.h"

namespace snapthrough::api {

/// A result and the duration of its analysis in seconds, measured by the caller.
struct TimedResult {
  Result result;
  double seconds = 0.0;
};

/// Solves the request of one point. Must be reentrant.
using SolvePoint = std::function<TimedResult(const Model&, const Analysis&, const Hooks&)>;

/// Returns all findings in one text.
[[nodiscard]] std::string sentence_of(const std::vector<Finding>& findings);

/// @brief Solves the request of a point and returns its outputs, or its failure.
/// @param seen gets a result that did not fail, whole; empty: not called
[[nodiscard]] PointOutcome solved_point(const Sweep& sweep,
                                        const std::shared_ptr<const nlohmann::json>& document,
                                        const SolvePoint& solve, const Hooks& hooks,
                                        const std::function<void(const Result&)>& seen = {});

}  // namespace snapthrough::api
