#pragma once
/// @file
/// The first loss of stability as a function of one number of the model.

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// What to follow.
struct CriticalCurveRequest {
  std::function<Model(double)> model;  ///< of a value; every one passed check()
  Analysis analysis;                   ///< of type `critical`, on a fixed mesh (elements and order are given)
  std::vector<double> values;          ///< ascending or descending, not empty
  bool logarithmic = false;            ///< the curve is smoother in the logarithm; values are positive then
  int check_every = 40;                ///< values from one check from scratch to the next, >= 1
  std::stop_token stop = {};  ///< asked to stop, the values that are left have the failure "cancelled"
};

/// One value and its first critical point.
struct CriticalCurvePoint {
  double value = 0.0;
  std::optional<double> load_factor;  ///< empty: no critical point, or a failure
  CriticalType type = CriticalType::limit_max;
  bool followed = false;  ///< from its neighbours; else its own path was traced
  std::string failure;    ///< code; empty unless the path could not be traced
};

struct CriticalCurve {
  std::vector<CriticalCurvePoint> points;  ///< in the order of the values
  int traced = 0;                          ///< paths that were traced, checks among them
  int followed = 0;                        ///< points that were reported from neighbours
  int inserted = 0;                        ///< values in between that were solved to get across
  int disagreed = 0;                       ///< checks that another critical point had come before
  int factorizations = 0;
};

/// @brief Follows the first critical point instead of tracing the path of each value.
///
/// A limit point that was found is predicted at the next value by extrapolation, as two equilibria of the
/// path shortly before and after it. Both are corrected on the model of that value, and the load's maximum
/// between them is that of the cubic through their loads and the loads' rates: at a limit point its error is
/// of fourth order in their distance. A point stands only when both are in equilibrium, the inertia before
/// and after is what it was, the load's rate changes its sign in between, and the interpolation's error is
/// below 1e-8 of the load. Where that fails the way is halved, at most seven times, and then the path is
/// traced.
///
/// That no other critical point has come before it is checked by tracing the path at every `check_every`-th
/// value and at the last: where the loads differ by more than 1e-6, all values since the check before are
/// traced. Bifurcations, and points at which contact jumps, are always traced.
/// @throws std::invalid_argument when a precondition on the request does not hold
[[nodiscard]] CriticalCurve follow_critical_point(const CriticalCurveRequest& request);

}  // namespace snapthrough
