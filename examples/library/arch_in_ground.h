// A pinned shallow arch in ground that can only push, with a load at its crown: that of examples/arch_outside_base_k1e7.json.
#pragma once

#include <snapthrough/solver/model/model.h>

#include <cmath>
#include <numbers>

inline snapthrough::Model arch_in_ground() {
  using namespace snapthrough;
  constexpr double kRadius = 100.0;
  constexpr double kEI = 1.4;
  const double half_span = kRadius * std::sin(10.0 * std::numbers::pi / 180.0);
  Model model;
  model.nodes = {{.id = "left", .x = -half_span, .y = 0.0}, {.id = "right", .x = half_span, .y = 0.0}};
  model.sections = {{.id = "rib", .EA = 300.0 * kEI, .EI = kEI, .GA = {}}};
  model.members = {{.id = "arch", .start = "left", .end = "right", .section = "rib", .curve = ArcCurve{-20.0}}};
  model.supports = {{.node = "left", .x = true, .y = true, .displacement = {}},
                    {.node = "right", .x = true, .y = true, .displacement = {}}};
  model.foundations = {{.id = "ground", .member = "arch", .stiffness = 1e7 * kEI / std::pow(kRadius, 4),
                        .reaction = Reaction::compression_only, .side = Side::left, .direction = {}}};
  const Location crown{.node = {}, .member = "arch", .fraction = 0.5};
  model.loads = {PointLoad{.at = crown, .force = {0.0, -kEI / (kRadius * kRadius)}}};
  return model;
}
