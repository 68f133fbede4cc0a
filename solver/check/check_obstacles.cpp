/// Check of supports beside rigid obstacles: a place that supports hold cannot be inside an obstacle.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "solver/check/check_parts.h"
#include "solver/geometry/axes.h"
#include "solver/model/id_index.h"
#include "solver/support/law.h"

namespace snapthrough::checks {

namespace {

/// Limits of what counts as touching an obstacle; ratios without unit, far above rounding.
struct ObstacleLimits {
  static constexpr double inside = 1e-9;  ///< depth inside the obstacle over the length of the member
  static constexpr double along = 1e-6;   ///< share of a normal along a direction that a support leaves free
  static constexpr double first_load = 1e-3;  ///< load factor that a path without a range passes
};

/// A displacement for a load factor, as the sum of a constant and a proportional part.
struct Motion {
  std::array<double, 2> constant{};
  std::array<double, 2> proportional{};

  void add(double x, double y, Pattern pattern) {
    auto& part = pattern == Pattern::constant ? constant : proportional;
    part[0] += x;
    part[1] += y;
  }
  [[nodiscard]] std::array<double, 2> at(double factor) const {
    return {constant[0] + factor * proportional[0], constant[1] + factor * proportional[1]};
  }
};

/// Load factors at which an analysis finds states: those of its rows, else the ends of the path's range, or a
/// first small load.
std::vector<double> wanted_factors(const Analysis& analysis) {
  if (analysis.traits().has_rows) return analysis.load_factors;
  if (analysis.traits().linearised) return {0.0, 1.0};
  if (analysis.traits().reports_path && analysis.stop.load_factor)
    return {0.0, (*analysis.stop.load_factor)[0], (*analysis.stop.load_factor)[1]};
  return {0.0, ObstacleLimits::first_load * analysis.step.direction};
}

/// Axes of a support, along which it holds its node or not.
struct SupportAxes {
  std::array<double, 2> x{};
  std::array<double, 2> y{};
  explicit SupportAxes(const Support& support) {
    const double angle = support.angle_degrees * std::numbers::pi / 180.0;
    x = {std::cos(angle), std::sin(angle)};
    y = {-x[1], x[0]};
  }
};

double dot(std::array<double, 2> a, std::array<double, 2> b) { return a[0] * b[0] + a[1] * b[1]; }

/// Whether a support holds its node along a direction.
bool holds(const Support& support, std::array<double, 2> direction) {
  const SupportAxes axes(support);
  return (support.x || std::abs(dot(axes.x, direction)) <= ObstacleLimits::along) &&
         (support.y || std::abs(dot(axes.y, direction)) <= ObstacleLimits::along);
}

/// Displacement of a supported node relative to the ground beside it.
Motion relative_motion(const Support& support, const Foundation& obstacle, double fraction) {
  Motion motion;
  if (const auto& moved = support.displacement) {
    const SupportAxes axes(support);
    motion.add(moved->x * axes.x[0] + moved->y * axes.y[0], moved->x * axes.x[1] + moved->y * axes.y[1],
               moved->pattern);
  }
  if (const auto& ground = obstacle.displacement)
    motion.add(-ground->x.at(fraction), -ground->y.at(fraction), ground->pattern);
  return motion;
}

/// A rigid obstacle beside an end of its member.
struct ObstacleEnd {
  const Foundation& obstacle;
  std::string node;
  PlaceOnAxis place;
  double length = 0.0;  ///< length of the member
  FoundationLaw law;
  bool is_linear = false;  ///< displacements are small

  /// Depth of the displaced node inside the obstacle; of small displacements to their first order.
  [[nodiscard]] double depth(std::array<double, 2> u) const {
    if (is_linear) return law.penetration(place, {}).depth + dot(law.initial_direction(place), u);
    return law.penetration(place, u).depth;
  }
};

/// Reports a support that holds its node inside the obstacle at a wanted load factor.
void check_support_at(const Place& root, const Model& model, std::size_t index, const ObstacleEnd& end,
                      const std::vector<double>& factors) {
  const Support& support = model.supports[index];
  if (support.node != end.node || !holds(support, end.law.initial_direction(end.place))) return;
  const Motion motion = relative_motion(support, end.obstacle, end.place.fraction);
  const auto depth = [&](double factor) { return end.depth(motion.at(factor)); };
  const auto deepest = std::ranges::max_element(factors, {}, depth);
  if (!(depth(*deepest) > ObstacleLimits::inside * end.length)) return;
  const Place at = root / "model" / "supports" / index;
  const Place field = support.displacement ? at / "displacement" : at / "node";
  field.report("enters_obstacle", "this support holds node " + in_quotes(end.node) + " " +
                                      text(depth(*deepest)) + " inside the rigid foundation " +
                                      in_quotes(end.obstacle.id) + " at load factor " + text(*deepest) +
                                      ": nothing enters it, and no equilibrium exists; give the foundation "
                                      "a stiffness, or a range that leaves the node out");
}

}  // namespace

void check_obstacles(const Place& root, const Model& model, const Analysis& analysis) {
  const auto is_rigid = [](const Foundation& one) { return !one.law && std::isinf(one.stiffness); };
  if (model.supports.empty() || std::ranges::none_of(model.foundations, is_rigid)) return;
  const IdIndex nodes(model.nodes);
  const IdIndex members(model.members);
  const std::array origin{model.nodes.front().x, model.nodes.front().y};
  const std::vector<double> factors = wanted_factors(analysis);
  const bool is_linear = analysis.geometry == Geometry::linear || analysis.traits().linearised;
  for (const Foundation& obstacle : model.foundations) {
    if (!is_rigid(obstacle)) continue;
    const Member& member = model.members[static_cast<std::size_t>(members.of(obstacle.member))];
    const auto node = [&](const std::string& id) {
      return model.nodes[static_cast<std::size_t>(nodes.of(id))];
    };
    const AxisCurve axis = axis_of(member.curve, model.nodes.front(), node(member.start), node(member.end));
    const double length = axis.length();
    for (const double fraction : obstacle.range) {
      if (fraction != 0.0 && fraction != 1.0) continue;
      const AxisPoint at = axis.at(fraction * length);
      const ObstacleEnd end{
          obstacle, fraction == 0.0 ? member.start : member.end, {{at.x, at.y}, at.angle, fraction},
          length,   law_of(obstacle, Scales{}, origin),          is_linear};
      for (std::size_t i = 0; i < model.supports.size(); ++i) check_support_at(root, model, i, end, factors);
    }
  }
}

}  // namespace snapthrough::checks
