#pragma once
/// @file
/// What a point of a chart shows beside its value, to tell what changes from one point to the next.
/// Internal to api/.

#include <map>
#include <string>

#include "api/sweep.h"
#include "api/sweep_data.h"

namespace snapthrough::api {

/// What distinguishes the answers of two neighbouring points of a chart.
struct ChartLabel {
  std::string failure;  ///< code of a point that failed
  std::string type;     ///< type of the critical point
  int reversals = -1;   ///< turning points of a buckling mode: changes of sign of its rotations; -1: no mode
  std::map<std::string, int> contact;  ///< zones of contact at the critical point, for ids that had an event

  /// Returns what must agree for points to be joined by a line.
  [[nodiscard]] std::string kind() const;
};

/// @brief Returns the label of a result for an output: that of critical point k for `/critical_points/k/...`,
/// of mode k for `/buckling/load_factors/k`, and otherwise that of the critical point of the summary.
[[nodiscard]] ChartLabel label_of(const Result& result, const SweepOutput& output);

/// @brief Returns what changes from one point to the next, such as "jump, type: limit_max to bifurcation".
/// @param jumps both points have a value, and it changes abruptly
/// @param has_value of both points
[[nodiscard]] std::string change_between(const ChartLabel& before, const ChartLabel& after, bool jumps,
                                         bool has_value_before, bool has_value_after);

}  // namespace snapthrough::api
