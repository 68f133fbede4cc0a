#pragma once
/// @file
/// Computes the units of a sweep: what becomes of their points.

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "api/sweep.h"
#include "solver/hooks.h"

namespace snapthrough::api {

/// A result and the seconds that its analysis took, as the caller's clock measured them.
struct TimedResult {
  Result result;
  double seconds = 0.0;
};

/// What solves the request of one point. Must be reentrant.
using SolvePoint = std::function<TimedResult(const Model&, const Analysis&, const Hooks&)>;

/// @brief The outcomes of a unit's points, in their order.
///
/// A document that is no valid request is the outcome "wrong_request", an analysis that fails is its code.
/// Asked to stop, at least one outcome is "cancelled" unless all were there. A point is solved by `solve`; a
/// curve is followed by follow_critical_point() (solver/sweep/critical_curve.h).
/// @param unit number of the unit, less than sweep.units()
/// @param document of a point of the sweep, to be written over; null makes a new one
/// Never throws for what an analysis does: a thrown exception is the outcome of every point (mishap_now()).
[[nodiscard]] std::vector<PointOutcome> unit_outcomes(const Sweep& sweep, std::uint64_t unit,
                                                      const SolvePoint& solve, const Hooks& hooks,
                                                      std::shared_ptr<nlohmann::json>& document);

/// Whether outcomes are missing because the unit was asked to stop.
[[nodiscard]] bool is_cut_short(const std::vector<PointOutcome>& outcomes);

/// @brief The exception that is being handled, as the outcome of a point: "out_of_memory" or
/// "internal_error".
/// @pre called in a catch block
[[nodiscard]] PointOutcome mishap_now();

}  // namespace snapthrough::api
