#pragma once
/// @file
/// Processor time that an analysis is expected to take, by a law fitted to measured times.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/sweep.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::api {

/// Expected processor time, in seconds of the machine that the law was fitted on.
struct ExpectedTime {
  double cpu_seconds = 0.0;  ///< processor time of the analysis, or of all points of a sweep; > 0
  /// Range of the measured requests of this type around the law: a tenth of them took less than `low`, a
  /// tenth more than `high`, 0 < low < high.
  double low = 0.0;
  double high = 0.0;
  std::string model;  ///< sentence: what the law was fitted to, and how far off it was
};

/// @brief Returns the expected time of one analysis. Reads only numbers and counts: makes no mesh.
/// @param unknowns free displacements of the first mesh
/// @pre check() found nothing in the model and the analysis
[[nodiscard]] ExpectedTime expected_time(const Model& model, const Analysis& analysis, int unknowns);

/// @brief Returns the expected time of a sweep, of all its points together.
/// @param points expected times of some of its points
/// @return the number of points times the median of `points`, or what the curves take where the sweep follows
/// them; nullopt where `points` is empty
[[nodiscard]] std::optional<ExpectedTime> expected_time(const Sweep& sweep, std::vector<ExpectedTime> points);

}  // namespace snapthrough::api
