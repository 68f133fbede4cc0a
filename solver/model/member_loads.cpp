#include "solver/model/member_loads.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/model/id_index.h"

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

Along<double> times(double factor, const Along<double>& along) {
  Along<double> out = along;
  for (auto& [fraction, value] : out) value *= factor;
  return out;
}

const Section& section_of(const Model& model, const Member& member) {
  return model.sections[static_cast<std::size_t>(index_of(model.sections, member.section))];
}

}  // namespace

Vec2 LinePiece::at(double fraction) const {
  return from == to ? from : between(from, to, (fraction - range[0]) / (range[1] - range[0]));
}

std::vector<LinePiece> pieces_of(const DistributedLoad& load) {
  std::vector<LinePiece> out;
  double from = load.range[0];
  const auto add_until = [&](double to) {
    out.push_back({{from, to},
                   value_at(load.force, load.force_along, from),
                   value_at(load.force, load.force_along, to)});
    from = to;
  };
  for (const auto& [fraction, force] : load.force_along)
    if (fraction > from + kOnePlace && fraction < load.range[1] - kOnePlace) add_until(fraction);
  add_until(load.range[1]);
  return out;
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

DistributedLoad weight_of(const Model& model, const Member& member, const SelfWeight& load) {
  const double mass = *section_of(model, member).mass;
  DistributedLoad out;
  out.member = member.id;
  out.force = {mass * load.gravity[0], mass * load.gravity[1]};
  out.pattern = load.pattern;
  return out;
}

InitialStrain strain_of(const Model& model, const TemperatureLoad& load) {
  const Member& member = model.members[static_cast<std::size_t>(index_of(model.members, load.member))];
  const double expansion = *section_of(model, member).expansion;
  InitialStrain out;
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
