#pragma once
/// @file
/// First loss of stability as a function of one number of the model.

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// Request for a curve of critical loads.
struct CriticalCurveRequest {
  std::function<Model(double)> model;  ///< model for a value; passed check()
  Analysis analysis;                   ///< type `critical` with a fixed mesh (elements and order)
  std::vector<double> values;          ///< ascending or descending, not empty
  bool logarithmic = false;            ///< extrapolates over the logarithm of the values, which are positive
  int check_every = 40;                ///< values between checks by a traced path, >= 1
  std::stop_token stop = {};           ///< on a stop request the remaining values get the failure "cancelled"
};

/// First critical point for one value.
struct CriticalCurvePoint {
  double value = 0.0;
  std::optional<double> load_factor;  ///< empty: no critical point, or a failure
  CriticalType type = CriticalType::limit_max;
  bool followed = false;  ///< solved from neighbouring values; false: its path was traced
  std::string failure;    ///< failure code; empty unless the path could not be traced
  /// Load factor up to which the traced path has no critical point; empty where one was found, or a failure.
  std::optional<double> none_up_to;
};

struct CriticalCurve {
  std::vector<CriticalCurvePoint> points;  ///< in the order of the values
  int traced = 0;                          ///< number of traced paths, checks included
  int followed = 0;                        ///< number of points from neighbouring values
  int inserted = 0;                        ///< number of additional intermediate values
  int disagreed = 0;                       ///< number of checks that found an earlier critical point
  int factorizations = 0;
};

/// @brief Follows the first critical point over the values instead of tracing a path for each value.
///
/// The critical point of a value is predicted by the polynomial through those of neighbouring values and
/// solved for on the structure of that value by Newton's method on the extended equations (LocusSolver), to
/// 1e-10 of its load. One value in up to eight is solved with factors of its own; its inertia must be that
/// of the known points. Values between use these factors, or their own where these converge slowly. Where
/// that fails the increment of the value is halved, at most seven times; then the path is traced.
///
/// After `check_every` values and at the last, a traced path verifies that no earlier critical point exists;
/// if its load differs by more than 1e-6, all values since the previous check are traced. Always traced:
/// multiple points, points caused by contact, paths with pinned motions or touching supports.
/// @throws std::invalid_argument when the request violates a precondition
[[nodiscard]] CriticalCurve follow_critical_point(const CriticalCurveRequest& request);

}  // namespace snapthrough
