#pragma once
/// @file
/// Curves of critical points over one number of the model, through the points where they turn back.

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"
#include "solver/sweep/locus_curve.h"

namespace snapthrough {

/// Request for the curves of critical points.
struct CriticalLocusRequest {
  std::function<Model(double)> model;  ///< model for a value between the values; passed check()
  Analysis analysis;                   ///< type `critical` with a fixed mesh (elements and order)
  std::vector<double> values;          ///< ascending or descending, at least two
  bool logarithmic = false;            ///< steps over the logarithm of the values, which are positive
  /// Critical point to begin with, counted from 0 along the path of the first value; empty: every critical
  /// point up to the second limit point on the paths of the first and of the last value.
  std::optional<int> number = {};
  std::stop_token stop = {};
};

struct CriticalLocus {
  std::vector<LocusCurve> curves;
  /// For each value the load factor up to which its path has no critical point; empty where it has one, or
  /// where a curve has a point.
  std::vector<std::optional<double>> none_up_to;
  std::string failure;  ///< failure code; empty unless a path could not be traced
  int factorizations = 0;
  int steps = 0;  ///< accepted steps along all curves
};

/// @brief Follows curves of critical points by pseudo-arclength in displacements, load and parameter.
///
/// A step is predicted along the curve's tangent and corrected in the plane normal to it (LocusSolver), so
/// that a curve turns back where limit points or bifurcations meet. Cusps are zeros of n.F''[n, n],
/// fold_bifurcations zeros of n.load or of the stiffness of another motion, turns zeros of the parameter's
/// rate; they are located to rounding. Each value that a curve passes is solved for.
///
/// The path of each value without a point is traced, to say up to which load it has none, or that its first
/// critical point lies on no followed curve: a curve without loads and with the event not_followed.
/// Curves that no followed path meets at the first or the last value are not found.
/// @throws std::invalid_argument when the request violates a precondition
[[nodiscard]] CriticalLocus follow_critical_locus(const CriticalLocusRequest& request);

}  // namespace snapthrough
