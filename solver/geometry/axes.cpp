#include "solver/geometry/axes.h"

#include <array>
#include <cstddef>
#include <variant>

namespace snapthrough {

AxisCurve axis_of(const Curve& curve, const Node& origin, const Node& a, const Node& b) {
  const std::array<double, 2> start{a.x - origin.x, a.y - origin.y};
  const std::array<double, 2> end{b.x - origin.x, b.y - origin.y};
  const auto* given = std::get_if<PointsCurve>(&curve);
  if (given == nullptr) return {curve, start, end};
  PointsCurve points = *given;
  for (auto& point : points.points) point = {point[0] - origin.x, point[1] - origin.y};
  return {points, start, end};
}

AxisCurve axis_of(const ResolvedModel& model, const ResolvedMember& member) {
  return axis_of(member.curve, model.nodes.front(), model.start_of(member), model.end_of(member));
}

Axes make_axes(const ResolvedModel& model) {
  Axes axes;
  for (const ResolvedMember& member : model.members)
    axes.push_back(std::make_shared<const AxisCurve>(axis_of(model, member)));
  return axes;
}

}  // namespace snapthrough
