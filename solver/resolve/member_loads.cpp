#include "solver/resolve/member_loads.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

Along<double> times(double factor, const Along<double>& along) {
  Along<double> out = along;
  for (auto& [fraction, value] : out) value *= factor;
  return out;
}

/// Pieces of a range between the fractions at which a force is given.
/// @param force_at force at a fraction
template <class T, class ForceAt>
std::vector<LinePiece> pieces_between(const Vec2& range, const Along<T>& along, ForceAt force_at) {
  std::vector<LinePiece> out;
  double from = range[0];
  const auto add_until = [&](double to) {
    out.push_back({{from, to}, force_at(from), force_at(to)});
    from = to;
  };
  for (const auto& [fraction, value] : along)
    if (fraction > from + kOnePlace && fraction < range[1] - kOnePlace) add_until(fraction);
  add_until(range[1]);
  return out;
}

}  // namespace

Vec2 LinePiece::at(double fraction) const {
  return from == to ? from : between(from, to, (fraction - range[0]) / (range[1] - range[0]), power);
}

LineLoad line_load(const ResolvedDistributedLoad& load) {
  const auto force_at = [&load](double fraction) { return value_at(load.force, load.force_along, fraction); };
  return {load.member, load.per, load.axes, load.pattern,
          pieces_between(load.range, load.force_along, force_at)};
}

double measure_of(LoadMeasure per, double angle) {
  if (per == LoadMeasure::horizontal) return std::abs(std::cos(angle));
  return per == LoadMeasure::vertical ? std::abs(std::sin(angle)) : 1.0;
}

Vec2 global_force(LoadAxes axes, const Vec2& force, double angle) {
  if (axes == LoadAxes::global) return force;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * force[0] - s * force[1], s * force[0] + c * force[1]};
}

LineLoad weight_of(const ResolvedModel& model, int member, const SelfWeight& load) {
  const AlongMember& mass = *model.section_of(model.members[static_cast<std::size_t>(member)]).mass;
  const auto force_at = [&](double fraction) {
    return Vec2{mass.at(fraction) * load.gravity[0], mass.at(fraction) * load.gravity[1]};
  };
  LineLoad out{member, LoadMeasure::length, LoadAxes::global, load.pattern,
               pieces_between({0.0, 1.0}, mass.points, force_at)};
  for (LinePiece& piece : out.pieces) piece.power = mass.power;
  return out;
}

ResolvedInitialStrain strain_of(const ResolvedModel& model, const ResolvedTemperatureLoad& load) {
  const double expansion = *model.section_of(model.members[static_cast<std::size_t>(load.member)]).expansion;
  ResolvedInitialStrain out;
  out.member = load.member;
  out.axial = expansion * load.change;
  // a fibre at the distance n along the left normal is strained by e - n k
  out.curvature = -expansion * load.gradient;
  out.pattern = load.pattern;
  out.axial_along = times(expansion, load.change_along);
  out.curvature_along = times(-expansion, load.gradient_along);
  return out;
}

}  // namespace snapthrough
