#include "solver/report/cable_state.h"

#include <cmath>
#include <vector>

#include "solver/mesh/dof_map.h"
#include "solver/report/peaks.h"

namespace snapthrough {

using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// A cable at a state and as it is drawn, in scaled units. `s` is the length from its start without force.
class HangingCable {
 public:
  HangingCable(const Structure& structure, std::size_t spring, const VectorXd& y)
      : spring_(rod_of(structure, spring)),
        start_(DofMap::displacement(y, spring_.node)),
        lengthening_(spring_.ends(y).lengthening),
        force_(cable().pull(spring_.ends(y)).force) {}

  [[nodiscard]] double length() const { return cable().length(); }
  /// Place as the cable is drawn, relative to its start.
  [[nodiscard]] Vector2d drawn(double s) const { return cable().place_at(spring_.drawn_pull, 0.0, s); }
  [[nodiscard]] Vector2d displacement(double s) const {
    return start_ + cable().place_at(force_, lengthening_, s) - drawn(s);
  }
  [[nodiscard]] double tension(double s) const { return cable().force_at(force_, s).norm(); }
  /// Angle from the tangent of the drawn cable to that of the state.
  [[nodiscard]] double rotation(double s) const {
    const Vector2d from = cable().force_at(spring_.drawn_pull, s);
    const Vector2d to = cable().force_at(force_, s);
    return std::atan2(from[0] * to[1] - from[1] * to[0], from.dot(to));
  }
  [[nodiscard]] double slackest() const { return cable().slackest(force_); }
  [[nodiscard]] double tightest() const { return cable().tightest(force_); }
  [[nodiscard]] Peak largest_displacement() const {
    PeakSearch<1> search;
    const auto size_at = [this](double s) { return std::array{displacement(s).norm()}; };
    const auto none = [](std::size_t) { return std::array{0.0}; };
    search.add_piece({}, none, {0.0, size_at(0.0)}, {length(), size_at(length())}, size_at);
    search.refine(size_at);
    return search.largest(0, 1.0, size_at);
  }

 private:
  [[nodiscard]] const Catenary& cable() const { return *spring_.cable; }

  NodeSpring spring_;
  Vector2d start_;
  double lengthening_;
  Vector2d force_;  ///< in the middle of the cable
};

/// Sets the extremes of a cable, and its stress over strength where the spring has one.
void set_extremes(const HangingCable& cable, const Scales& scales, const ResolvedSpring& spring,
                  MemberState& out) {
  const auto force = [&](double s) { return Peak{scales.force * cable.tension(s), scales.length * s}; };
  const Peak none{0.0, 0.0};
  const Peak moved = cable.largest_displacement();
  const Peak largest = force(cable.tightest());
  out.extremes = {{force(cable.slackest()), largest},
                  {none, none},
                  {none, none},
                  {scales.length * moved.value, scales.length * moved.s},
                  {}};
  if (!spring.strength) return;
  for (const double tension : out.axial_force) out.utilisation_left.push_back(tension / *spring.strength);
  out.utilisation_right = out.utilisation_left;
  out.extremes.utilisation = {largest.value / *spring.strength, largest.s, Fibre::left};
}

}  // namespace

Peak largest_tension(const Structure& structure, std::size_t spring, const VectorXd& y) {
  const HangingCable cable(structure, spring, y);
  const double s = cable.tightest();
  return {structure.scales.force * cable.tension(s), structure.scales.length * s};
}

MemberState cable_state(const Structure& structure, std::size_t spring, const VectorXd& y, int points) {
  const ResolvedSpring& given = structure.model->springs[spring];
  const Scales& scales = structure.scales;
  const Node& start = structure.model->nodes[static_cast<std::size_t>(given.at.node)];
  const HangingCable cable(structure, spring, y);
  MemberState out;
  out.id = given.id;
  for (int i = 0; i < points; ++i) {
    const double s = cable.length() * i / (points - 1);
    const Vector2d drawn = scales.length * cable.drawn(s);
    const Vector2d moved = scales.length * cable.displacement(s);
    out.s.push_back(scales.length * s);
    out.x0.push_back(start.x + drawn[0]);
    out.y0.push_back(start.y + drawn[1]);
    out.u.push_back(moved[0]);
    out.v.push_back(moved[1]);
    out.x.push_back(out.x0.back() + moved[0]);
    out.y.push_back(out.y0.back() + moved[1]);
    out.rotation.push_back(cable.rotation(s));
    out.axial_force.push_back(scales.force * cable.tension(s));
  }
  out.shear_force.assign(out.s.size(), 0.0);
  out.bending_moment.assign(out.s.size(), 0.0);
  set_extremes(cable, scales, given, out);
  return out;
}

}  // namespace snapthrough
