#include "solver/discrete/rigid_loads.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "solver/numeric/gauss_rule.h"
#include "solver/resolve/pieces.h"

namespace snapthrough {
namespace {

/// Varying pressure as a load across the undeformed axis.
LineAction across(const PressureAction& load) {
  const double sense = load.side == Side::left ? -1.0 : 1.0;
  Along<std::array<double, 2>> forces;
  for (const auto& [fraction, value] : load.value_along)
    forces.emplace_back(fraction, std::array{0.0, sense * value});
  return {load.member, LoadMeasure::length, LoadAxes::member, load.pattern,
          pieces_of({0.0, 1.0}, {0.0, 0.0}, forces)};
}

/// Sums the work of one load.
class Summing {
 public:
  explicit Summing(const RigidParts& parts) : parts_(parts) {}

  void add(const PointAction& load);
  void add(const LineAction& load);
  void add(const PressureAction& load);
  void add(const StrainAction&) {}
  LoadWork work;

 private:
  void add(const RigidParts::Row& row, double force) {
    work.size += std::abs(force);
    for (const auto& [unknown, weight] : row) work.row.emplace_back(unknown, force * weight);
  }
  void add(int member, RigidParts::Point at, double x, double y) {
    add(parts_.displacement(member, at, {1.0, 0.0}), x);
    add(parts_.displacement(member, at, {0.0, 1.0}), y);
  }

  const RigidParts& parts_;
};

void Summing::add(const PointAction& load) {
  const double moment = load.moment / parts_.length();
  if (!load.at.is_on_member()) {
    const int node = load.at.node;
    add(parts_.displacement(node, {1.0, 0.0}), load.force[0]);
    add(parts_.displacement(node, {0.0, 1.0}), load.force[1]);
    add(parts_.node_rotation(node), moment);
    return;
  }
  const int member = load.at.member;
  const AxisPoint at = parts_.place(member, load.at.fraction);
  add(member, {at.x, at.y}, load.force[0], load.force[1]);
  add(parts_.rotation(member), moment);
}

void Summing::add(const LineAction& load) {
  const int member = load.member;
  const AxisCurve& axis = *parts_.axes()[static_cast<std::size_t>(member)];
  const bool is_linear = std::all_of(load.pieces.begin(), load.pieces.end(),
                                     [](const LinePiece& piece) { return piece.power == 1.0; });
  const bool is_exact = axis.straight() && is_linear;
  const Quadrature gauss = gauss_legendre(is_exact ? 2 : 8);
  const int intervals = is_exact ? 1 : 4;
  for (const LinePiece& piece : load.pieces) {
    const double width = (piece.range[1] - piece.range[0]) / intervals;
    for (std::size_t i = 0; i < gauss.points.size() * static_cast<std::size_t>(intervals); ++i) {
      const std::size_t q = i % gauss.points.size();
      const auto interval = static_cast<double>(i / gauss.points.size());
      const double fraction = piece.range[0] + width * (interval + gauss.points[q]);
      const AxisPoint at = parts_.place(member, fraction);
      const double w = axis.length() * width * gauss.weights[q] * measure_of(load.per, at.angle);
      const auto force = global_force(load.axes, piece.at(fraction), at.angle);
      add(member, {at.x, at.y}, w * force[0], w * force[1]);
    }
  }
}

/// Replaces a constant pressure by pressure on the chord: with the right normal n = (t_y, -t_x), int n ds is
/// the chord turned by -90 degrees, and the moment about the start is int (x - x_a) x n ds = -|x_b - x_a|^2
/// / 2.
void Summing::add(const PressureAction& load) {
  if (!load.value_along.empty()) {
    add(across(load));
    return;
  }
  const int member = load.member;
  const AxisPoint a = parts_.place(member, 0.0);
  const AxisPoint b = parts_.place(member, 1.0);
  const double force = (load.side == Side::left ? 1.0 : -1.0) * load.value * parts_.length();
  add(member, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, force * (b.y - a.y), -force * (b.x - a.x));
}

}  // namespace

std::vector<LoadWork> works_of_loads(const RigidParts& parts) {
  std::vector<LoadWork> out;
  const std::vector<Action>& actions = parts.model().actions;
  for (std::size_t i = 0; i < actions.size();) {
    const int load = actions[i].load;
    Summing sum(parts);
    sum.work.pattern = actions[i].pattern();
    sum.work.name = actions[i].name;
    for (; i < actions.size() && actions[i].load == load; ++i)
      std::visit([&sum](const auto& one) { sum.add(one); }, actions[i].what);
    out.push_back(std::move(sum.work));
  }
  return out;
}

RigidLoads::RigidLoads(const RigidParts& parts, Pattern pattern)
    : forces_(Eigen::VectorXd::Zero(parts.unknowns())) {
  for (const LoadWork& work : works_of_loads(parts)) {
    if (work.pattern != pattern) continue;
    size_ += work.size;
    for (const auto& [unknown, force] : work.row) forces_[unknown] += force;
  }
}

}  // namespace snapthrough
