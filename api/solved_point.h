#pragma once
/// @file
/// Outcome of one point of a sweep. Internal to api/.

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "api/sweep.h"
#include "api/sweep_unit.h"

namespace snapthrough::api {

/// Returns all findings in one text.
[[nodiscard]] std::string sentence_of(const std::vector<Finding>& findings);

/// @brief Solves the request of a point and returns its outputs, or its failure.
/// @param seen gets a result that did not fail, whole; empty: not called
[[nodiscard]] PointOutcome solved_point(const Sweep& sweep,
                                        const std::shared_ptr<const nlohmann::json>& document,
                                        const SolvePoint& solve, const Hooks& hooks,
                                        const std::function<void(const Result&)>& seen = {});

}  // namespace snapthrough::api
