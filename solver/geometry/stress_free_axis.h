#pragma once
/// @file
/// Stress-free axis of a member: perfect axis plus imperfections.

#include <memory>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/geometry/axis_curve.h"
#include "solver/geometry/cubic_spline.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Point of the stress-free axis, with its derivative with respect to the perfect axis' arc length.
struct StressFreePoint {
  double x = 0.0, y = 0.0;
  double angle = 0.0;    ///< angle of the tangent, rad, continuous
  double stretch = 1.0;  ///< length of the derivative
};

/// Offsets from buckling modes: splines over arc length (model's units) for each member.
using ModeOffsets = std::vector<std::vector<CubicSpline>>;

/// @brief Perfect axis plus offsets w(s) along its left normal: c = X + w n, c' = t (1 - kappa w) + n w'.
///
/// Sine imperfections are exact. Imperfections by points are C2 splines, zero at an end without a point.
class StressFreeAxis {
 public:
  /// @param modes offsets from buckling modes; may be empty
  StressFreeAxis(const ResolvedModel& model, int member, std::shared_ptr<const AxisCurve> axis,
                 const std::vector<CubicSpline>& modes);
  [[nodiscard]] StressFreePoint at(double s) const { return at(s, axis_->at(s)); }
  /// @param perfect perfect axis at s
  [[nodiscard]] StressFreePoint at(double s, const AxisPoint& perfect) const;
  [[nodiscard]] const AxisCurve& perfect() const { return *axis_; }

 private:
  struct Sine {
    double wave_number;
    double amplitude;
  };
  std::shared_ptr<const AxisCurve> axis_;
  std::vector<Sine> sines_;
  std::vector<CubicSpline> splines_;
};

}  // namespace snapthrough
