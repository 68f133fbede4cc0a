#pragma once
/// @file
/// Curves and surfaces of refined sweeps. Internal to api/.

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "api/point_outcome.h"
#include "api/solved_point.h"
#include "api/sweep.h"
#include "solver/hooks.h"

namespace snapthrough::api {

/// @brief Returns the outcome of a curve or surface: a JSON array with `[point, outputs, error, piece,
/// change]` for each row, in the order of points. `outputs` is null in a failed row, `error` (code and
/// detail) in others, `change` where no piece begins.
///
/// It fails as a whole with `refinement_limit` when `refine.most` points are not enough, and with
/// `outputs_too_large`. Places are chosen by chart_curve() and chart_surface() (solver/sweep/chart.h).
/// @param number of the curve or surface, less than sweep.size()
/// @param document see item_outcomes()
/// @pre sweep.refines()
[[nodiscard]] PointOutcome refined_outcome(const Sweep& sweep, std::uint64_t number, const SolvePoint& solve,
                                           const Hooks& hooks, std::shared_ptr<nlohmann::json>& document);

}  // namespace snapthrough::api
