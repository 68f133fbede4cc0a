#pragma once
/// @file
/// Computes the outcomes of the points of an item of a sweep.

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "api/point_outcome.h"
#include "api/solved_point.h"
#include "api/sweep.h"
#include "solver/hooks.h"

namespace snapthrough::api {

/// @brief Returns the outcomes of an item's points in their order.
///
/// An invalid request has the outcome "wrong_request", a failed analysis its failure code. After a request to
/// stop, at least one outcome is "cancelled" unless all points are complete. `solve` solves a point;
/// follow_critical_point() or follow_critical_locus() (solver/sweep/) computes a curve.
/// @param item number of the item, less than sweep.items()
/// @param document document of any point of the sweep, which is overwritten; null creates a document
/// An exception does not leave the function: it becomes the outcome of every point (mishap_now()).
[[nodiscard]] std::vector<PointOutcome> item_outcomes(const Sweep& sweep, std::uint64_t item,
                                                      const SolvePoint& solve, const Hooks& hooks,
                                                      std::shared_ptr<nlohmann::json>& document);

/// Returns whether a request to stop left outcomes incomplete.
[[nodiscard]] bool is_cut_short(const std::vector<PointOutcome>& outcomes);

/// @brief Returns the current exception as the outcome of a point: "out_of_memory" or "internal_error".
/// @pre called in a catch block
[[nodiscard]] PointOutcome mishap_now();

}  // namespace snapthrough::api
