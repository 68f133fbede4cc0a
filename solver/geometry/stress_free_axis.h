#pragma once
/// @file
/// Stress-free axis of a member: the perfect axis with its imperfections.

#include <memory>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/geometry/axis_curve.h"
#include "solver/geometry/cubic_spline.h"
#include "solver/model/model.h"

namespace snapthrough {

/// A point of the stress-free axis and its derivative by the perfect axis' arc length.
struct StressFreePoint {
  double x = 0.0, y = 0.0;
  double angle = 0.0;    ///< of the tangent, continuous
  double stretch = 1.0;  ///< length of the derivative
};

/// Offsets from buckling modes: for each member, splines over the arc length in the model's units.
using ModeOffsets = std::vector<std::vector<CubicSpline>>;

/// @brief The perfect axis plus the offsets w(s) along its left normal: c = X + w n, c' = t (1 - kappa w) + n
/// w'.
///
/// Sine imperfections are exact; those given by points are C2 splines, with zero offset added at an end that
/// is not given.
class StressFreeAxis {
 public:
  /// @param modes offsets from buckling modes, may be empty
  StressFreeAxis(const Model& model, int member, std::shared_ptr<const AxisCurve> axis,
                 const std::vector<CubicSpline>& modes);
  [[nodiscard]] StressFreePoint at(double s) const { return at(s, axis_->at(s)); }
  /// @param perfect the perfect axis at s
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
