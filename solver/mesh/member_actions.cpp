#include "solver/mesh/member_actions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <variant>

#include "solver/numeric/rounding.h"
#include "solver/support/law.h"
#include "solver/support/law_numbers.h"

namespace snapthrough {
namespace {

/// Adds the fractions of the points of a number along a member.
template <class Along>
void add_points(const Along& along, std::vector<double>& places) {
  for (const auto& point : along) places.push_back(point.first);
}

/// Adds those of the points that lie inside a range.
template <class Along>
void add_points_inside(const Along& along, std::array<double, 2> range, std::vector<double>& places) {
  for (const auto& point : along)
    if (point.first > range[0] && point.first < range[1]) places.push_back(point.first);
}

/// Intervals of the spline through the offsets and the ends of the member.
double intervals_of(const ResolvedPointsImperfection& points) {
  const int ends = (points.offsets.front()[0] > 0.0 ? 1 : 0) + (points.offsets.back()[0] < 1.0 ? 1 : 0);
  return static_cast<double>(points.offsets.size()) - 1.0 + ends;
}

/// Collects what acts on each member.
class Collector {
 public:
  explicit Collector(const ResolvedModel& model)
      : model_(model), actions_(model.members.size(), {{0.0, 1.0}, {}, nullptr, 0.0}) {}

  std::vector<MemberActions> collect() && {
    add_sections();
    for (const ResolvedSpring& spring : model_.springs) add(spring.at);
    for (const ResolvedPointMass& mass : model_.masses) add(mass.at);
    for (const ResolvedFoundation& foundation : model_.foundations) add(foundation);
    for (const Action& action : model_.actions)
      std::visit([this](const auto& one) { add(one); }, action.what);
    for (const ResolvedImperfection& imperfection : model_.imperfections)
      std::visit([this](const auto& one) { add(one); }, imperfection);
    return std::move(actions_);
  }

 private:
  MemberActions& on(int member) { return actions_[static_cast<std::size_t>(member)]; }

  void add_sections() {
    for (std::size_t m = 0; m < model_.members.size(); ++m) {
      const Section& section = model_.section_of(model_.members[m]);
      MemberActions& actions = actions_[m];
      actions.section = &section;
      for (const AlongMember* value : {&section.EA, &section.EI}) add_points(value->points, actions.places);
      for (const auto* value : {&section.GA, &section.mass, &section.rotary_inertia})
        if (*value) add_points((*value)->points, actions.places);
    }
  }

  /// Place on a member; one at a node has none.
  void add(const ResolvedLocation& at) {
    if (at.is_on_member()) on(at.member).places.push_back(at.fraction);
  }

  void add(const ResolvedFoundation& foundation) {
    MemberActions& actions = on(foundation.member);
    std::vector<double>& places = actions.places;
    actions.foundations.push_back(&foundation);
    places.insert(places.end(), foundation.range.begin(), foundation.range.end());
    if (foundation.law) {
      const LawNumbers numbers = numbers_of(*foundation.law);
      add_points_inside(numbers.stiffness.points, foundation.range, places);
      add_points_inside(numbers.capacity.points, foundation.range, places);
    }
    add_points_inside(foundation.gap_along, foundation.range, places);
    if (!foundation.displacement) return;
    add_points(foundation.displacement->x.points, places);
    add_points(foundation.displacement->y.points, places);
  }

  void add(const PointAction& load) { add(load.at); }
  void add(const LineAction& load) {
    std::vector<double>& places = on(load.member).places;
    for (const LinePiece& piece : load.pieces)
      places.insert(places.end(), piece.range.begin(), piece.range.end());
  }
  void add(const PressureAction& load) { add_points(load.value_along, on(load.member).places); }
  void add(const StrainAction& strain) {
    add_points(strain.axial_along, on(strain.member).places);
    add_points(strain.curvature_along, on(strain.member).places);
  }

  void add(const ResolvedSineImperfection& sine) { need(sine.member, 2.0 * sine.half_waves); }
  void add(const ResolvedPointsImperfection& points) { need(points.member, intervals_of(points)); }
  // these put no element ends on a member
  void add(const ModeImperfection& /*mode*/) {}
  void add(const WorstImperfection& /*worst*/) {}

  void need(int member, double elements) {
    double& least = on(member).imperfection_elements;
    least = std::max(least, elements);
  }

  const ResolvedModel& model_;
  std::vector<MemberActions> actions_;
};

}  // namespace

std::vector<MemberActions> actions_on_members(const ResolvedModel& model) {
  return Collector(model).collect();
}

std::vector<double> breaks_of(const MemberActions& actions, const AxisCurve& axis) {
  std::vector<double> at = actions.places;
  for (const double knot : axis.knots()) at.push_back(knot / axis.length());
  std::sort(at.begin(), at.end());
  std::vector<double> unique;
  for (const double fraction : at)
    if (unique.empty() || fraction - unique.back() > kOnePlace) unique.push_back(fraction);
  unique.back() = 1.0;
  return unique;
}

}  // namespace snapthrough
