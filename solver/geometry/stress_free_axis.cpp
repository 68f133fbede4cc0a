#include "solver/geometry/stress_free_axis.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

namespace snapthrough {
namespace {

CubicSpline spline_of(const ResolvedPointsImperfection& points, double length) {
  std::vector<double> s;
  std::vector<double> w;
  if (points.offsets.empty() || points.offsets.front()[0] > 0.0) {
    s.push_back(0.0);
    w.push_back(0.0);
  }
  for (const auto& [fraction, offset] : points.offsets) {
    s.push_back(fraction * length);
    w.push_back(offset);
  }
  if (s.back() < length) {
    s.push_back(length);
    w.push_back(0.0);
  }
  return {s, w};
}

}  // namespace

StressFreeAxis::StressFreeAxis(const ResolvedModel& model, int member, std::shared_ptr<const AxisCurve> axis,
                               const std::vector<CubicSpline>& modes)
    : axis_(std::move(axis)), splines_(modes) {
  for (const ResolvedImperfection& imperfection : model.imperfections) {
    const auto* sine = std::get_if<ResolvedSineImperfection>(&imperfection);
    if (sine != nullptr && sine->member == member && sine->amplitude != 0.0)
      sines_.push_back({sine->half_waves * std::numbers::pi / axis_->length(), sine->amplitude});
    const auto* points = std::get_if<ResolvedPointsImperfection>(&imperfection);
    if (points != nullptr && points->member == member)
      splines_.push_back(spline_of(*points, axis_->length()));
  }
}

StressFreePoint StressFreeAxis::at(double s, const AxisPoint& p) const {
  if (sines_.empty() && splines_.empty()) return {p.x, p.y, p.angle, 1.0};
  double w = 0.0;
  double dw = 0.0;
  for (const Sine& sine : sines_) {
    w += sine.amplitude * std::sin(sine.wave_number * s);
    dw += sine.amplitude * sine.wave_number * std::cos(sine.wave_number * s);
  }
  for (const CubicSpline& spline : splines_) {
    const auto value = spline.at(s);
    w += value[0];
    dw += value[1];
  }
  const double along = 1.0 - p.curvature * w;
  return {p.x - w * std::sin(p.angle), p.y + w * std::cos(p.angle), p.angle + std::atan2(dw, along),
          std::hypot(along, dw)};
}

}  // namespace snapthrough
