#pragma once
/// @file
/// What a point of a sweep gives, as texts.

#include <string>

namespace snapthrough::api {

/// Outcome of a point: outputs or a failure.
struct PointOutcome {
  std::string outputs = {};  ///< JSON array with one value for each output; empty: the point failed
  std::string code = {};     ///< failure code, such as "no_convergence"; empty: no failure
  std::string detail = {};   ///< sentence about the failure

  [[nodiscard]] bool failed() const { return !code.empty(); }
};

}  // namespace snapthrough::api
