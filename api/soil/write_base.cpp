#include "api/soil/write_base.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "api/soil/faces.h"

namespace snapthrough::api::soil {

namespace {

using nlohmann::json;

/// Adds a spring, where the curve has a resistance.
void add_spring(const Pile& pile, const Base& base, const char* name, json direction, const char* reaction,
                const Curve& curve, json& springs) {
  if (!curve.has_resistance()) {
    return;
  }
  springs.push_back({{"id", pile.id + " base " + name},
                     {"at", {{"node", base.node}}},
                     {"direction", std::move(direction)},
                     {"reaction", reaction},
                     {"law", {{"type", "table"}, {"points", curve.points}, {"interpolation", "linear"}}}});
}

}  // namespace

json write_base(const Profile& profile, const Pile& pile, const Base& base) {
  json springs = json::array();
  const double tip = pile.tip_depth();
  double stress = 0.0;
  const Layer* layer = nullptr;
  for (const Layer& one : profile.layers) {
    if (one.from < tip) {
      layer = &one;
      stress += one.gamma * (std::min(one.to, tip) - one.from);
    }
  }
  if (layer == nullptr || tip <= pile.held_from) {
    return springs;
  }
  const Place place{tip, stress, pile.diameter, tip, layer->top, profile.loading};
  if (const auto* faces = std::get_if<Faces<LayerType>>(&layer->soil)) {
    const double fraction = std::min((tip - layer->from) / (layer->to - layer->from), 1.0);
    std::visit(
        [&](const auto& type) {
          if constexpr (requires { base_shear_curve_of(type, place, profile.accuracy); }) {
            add_spring(pile, base, "shear", base.across, "bilateral",
                       base_shear_curve_of(type, place, profile.accuracy), springs);
            add_spring(pile, base, "moment", "rotation", "bilateral",
                       base_moment_curve_of(type, place, profile.accuracy), springs);
          }
        },
        at(*faces, fraction));
  }
  if (layer->end_bearing) {
    const double area = 0.25 * std::numbers::pi * pile.diameter * pile.diameter;
    add_spring(pile, base, "bearing", base.down, "compression_only",
               tip_curve_of(ApiQz{*layer->end_bearing, area}, place), springs);
  }
  return springs;
}

}  // namespace snapthrough::api::soil
