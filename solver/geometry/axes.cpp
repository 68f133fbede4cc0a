#include "solver/geometry/axes.h"

#include <array>
#include <cstddef>
#include <variant>

namespace snapthrough {

AxisCurve axis_of(const Model& model, const IdIndex& nodes, const Member& member) {
  const Node& origin = model.nodes.front();
  const Node& a = model.nodes[static_cast<std::size_t>(nodes.of(member.start))];
  const Node& b = model.nodes[static_cast<std::size_t>(nodes.of(member.end))];
  const std::array<double, 2> start{a.x - origin.x, a.y - origin.y};
  const std::array<double, 2> end{b.x - origin.x, b.y - origin.y};
  const auto* given = std::get_if<PointsCurve>(&member.curve);
  if (given == nullptr) return {member.curve, start, end};
  PointsCurve points = *given;
  for (auto& point : points.points) point = {point[0] - origin.x, point[1] - origin.y};
  return {points, start, end};
}

Axes make_axes(const Model& model) {
  const IdIndex nodes(model.nodes);
  Axes axes;
  for (const Member& member : model.members)
    axes.push_back(std::make_shared<const AxisCurve>(axis_of(model, nodes, member)));
  return axes;
}

}  // namespace snapthrough
