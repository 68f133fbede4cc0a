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
  bool followed = false;  ///< extrapolated from neighbouring values; false: its path was traced
  std::string failure;    ///< failure code; empty unless the path could not be traced
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
/// The critical point is predicted at the next value by extrapolating two equilibria shortly before and after
/// it. Both are corrected on the model of that value. A limit point is the maximum of the cubic through their
/// loads and load rates, with an error of fourth order in their distance; a bifurcation is the zero of the
/// determinant on a parabola. The point is accepted when both equilibria exist with the expected inertia and
/// the interpolation error is below 1e-8 of the load. Otherwise the increment of the value is halved, at most
/// seven times; then the path is traced.
///
/// At every `check_every`-th value and at the last, a traced path verifies that no earlier critical point
/// exists; if its load differs by more than 1e-6, all values since the previous check are traced. Always
/// traced: multiple points, points caused by contact, paths with pinned motions or touching supports.
/// @throws std::invalid_argument when the request violates a precondition
[[nodiscard]] CriticalCurve follow_critical_point(const CriticalCurveRequest& request);

}  // namespace snapthrough
