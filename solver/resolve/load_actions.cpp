#include "solver/resolve/load_actions.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "solver/resolve/pieces.h"
#include "solver/resolve/pretension.h"

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

Along<double> times(double factor, const Along<double>& along) {
  Along<double> out = along;
  for (auto& [fraction, value] : out) value *= factor;
  return out;
}

/// Weight per length of a member.
LineAction weight_of(int member, const AlongMember& mass, const SelfWeight& load) {
  const auto force_at = [&](double fraction) {
    return Vec2{mass.at(fraction) * load.gravity[0], mass.at(fraction) * load.gravity[1]};
  };
  LineAction out{member, LoadMeasure::length, LoadAxes::global, load.pattern,
                 pieces_between({0.0, 1.0}, mass.points, force_at)};
  for (LinePiece& piece : out.pieces) piece.power = mass.power;
  return out;
}

/// Strain by temperature of a section with a coefficient of expansion.
StrainAction strain_of(const OnMember<TemperatureLoad>& load, double expansion) {
  StrainAction out;
  out.member = load.member;
  out.axial = expansion * load.change;
  // a fibre at the distance n along the left normal is strained by e - n k
  out.curvature = -expansion * load.gradient;
  out.pattern = load.pattern;
  out.axial_along = times(expansion, load.change_along);
  out.curvature_along = times(-expansion, load.gradient_along);
  return out;
}

}  // namespace

std::string LoadActions::named(int member) const {
  return "member \"" + out_.members[static_cast<std::size_t>(member)].id + "\"";
}

void LoadActions::act_on(int member, Action action) {
  out_.actions_on_member[static_cast<std::size_t>(member)].push_back(static_cast<int>(out_.actions.size()));
  out_.actions.push_back(std::move(action));
}

void LoadActions::add(const AtLocation<PointLoad>& load) {
  if (load.at.is_on_member())
    act_on(load.at.member, {load, load_, "the point load on " + named(load.at.member)});
  else
    out_.actions.push_back(
        {load, load_,
         "the point load at node \"" + out_.nodes[static_cast<std::size_t>(load.at.node)].id + "\""});
}

void LoadActions::add(const OnMember<DistributedLoad>& load) {
  const LineAction line{load.member, load.per, load.axes, load.pattern,
                        pieces_of(load.range, load.force, load.force_along)};
  act_on(load.member, {line, load_, "the distributed load on " + named(load.member)});
}

void LoadActions::add(const OnMember<PressureLoad>& load) {
  act_on(load.member, {load, load_, "the pressure on " + named(load.member)});
}

void LoadActions::add(const OnMember<InitialStrain>& load) {
  act_on(load.member, {load, load_, "the initial strain of " + named(load.member)});
}

void LoadActions::add_pretension(int member) {
  const ResolvedMember& one = out_.members[static_cast<std::size_t>(member)];
  const StrainAction strain{
      strain_without_force(one, out_.start_of(one), out_.end_of(one), out_.section_of(one).EA), member};
  act_on(member, {strain, load_, "the pretension of " + named(member)});
}

void LoadActions::add(const SelfWeight& load) {
  for (std::size_t m = 0; m < out_.members.size(); ++m) {
    const int member = static_cast<int>(m);
    const AlongMember& mass = *out_.section_of(out_.members[m]).mass;
    act_on(member, {weight_of(member, mass, load), load_, "the self weight"});
  }
}

void LoadActions::add(const OnMember<TemperatureLoad>& load) {
  const ResolvedMember& member = out_.members[static_cast<std::size_t>(load.member)];
  act_on(load.member, {strain_of(load, *out_.section_of(member).expansion), load_,
                       "the temperature of " + named(load.member)});
}

}  // namespace snapthrough
