#include "solver/geometry/axes.h"

#include <array>
#include <variant>

#include "solver/model/id_index.h"

namespace snapthrough {

Axes make_axes(const Model& model) {
  const Node& origin = model.nodes.front();
  const IdIndex nodes(model.nodes);
  Axes axes;
  for (const Member& member : model.members) {
    const Node& a = model.nodes[nodes.of(member.start)];
    const Node& b = model.nodes[nodes.of(member.end)];
    Curve curve = member.curve;
    if (auto* points = std::get_if<PointsCurve>(&curve))
      for (auto& point : points->points) point = {point[0] - origin.x, point[1] - origin.y};
    const std::array<double, 2> start{a.x - origin.x, a.y - origin.y};
    const std::array<double, 2> end{b.x - origin.x, b.y - origin.y};
    axes.push_back(std::make_shared<const AxisCurve>(curve, start, end));
  }
  return axes;
}

}  // namespace snapthrough
