#pragma once
/// @file
/// Structures that several tests share.

#include <cmath>
#include <numbers>
#include <optional>

#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::testing {

/// Circular arch of radius 100 over `sweep` degrees, crown up, with a crown load P = lambda EI / R^2.
inline Model arch(double sweep_degrees, double EA, double EI, bool clamped_start = false) {
  const double half = 0.5 * sweep_degrees * std::numbers::pi / 180.0;
  Model model;
  model.nodes = {{"a", -100.0 * std::sin(half), 0.0}, {"b", 100.0 * std::sin(half), 0.0}};
  model.sections = {{"s", EA, EI, {}}};
  Member member;
  member.id = "arch";
  member.start = "a";
  member.end = "b";
  member.section = "s";
  member.curve = ArcCurve{-sweep_degrees};
  model.members = {member};
  model.supports = {{"a", true, true, clamped_start, 0.0, {}}, {"b", true, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"", "arch", 0.5}, {0.0, -EI / 1e4}, 0.0, Pattern::proportional}};
  model.monitors = {{"crown", {"", "arch", 0.5}, Component::y}};
  return model;
}

/// Compression-only base outside the arch (or inside it) of dimensionless stiffness k = K R^4 / EI.
inline void add_soil(Model& model, double k, Side side = Side::left) {
  Foundation soil;
  soil.id = "soil";
  soil.member = "arch";
  soil.stiffness = k * model.sections[0].EI.constant / 1e8;
  soil.reaction = Reaction::compression_only;
  soil.side = side;
  model.foundations.push_back(soil);
}

/// Half a ring from its bottom to its top, R = 10, EI = 30e3, in a compression-only medium outside of
/// dimensionless stiffness k = K R^4 / EI that alone holds it vertically; dead load EI / R^3 down by length.
inline Model half_ring_in_medium(double k, double EA) {
  constexpr double kRadius = 10.0;
  constexpr double kEI = 30e3;
  Model model;
  model.nodes = {{"bottom", 0.0, -kRadius}, {"top", 0.0, kRadius}};
  model.sections = {{"s", EA, kEI, {}}};
  model.members = {{"m", "bottom", "top", "s", ArcCurve{180.0}, false, false}};
  model.supports = {{"bottom", true, false, true, 0.0, {}}, {"top", true, false, true, 0.0, {}}};
  Foundation soil;
  soil.id = "soil";
  soil.member = "m";
  soil.stiffness = k * kEI / std::pow(kRadius, 4);
  soil.reaction = Reaction::compression_only;
  soil.side = Side::right;
  model.foundations = {soil};
  model.loads = {DistributedLoad{
      "m", {0.0, -kEI / std::pow(kRadius, 3)}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  return model;
}

/// Lee's frame, L = 120, EI = 1.44e7: the load factor is P L^2 / EI.
inline Model lee_frame(double EA, std::optional<double> GA = {}) {
  constexpr double kLength = 120.0;
  Model model;
  model.nodes = {{"foot", 0.0, 0.0}, {"corner", 0.0, kLength}, {"end", kLength, kLength}};
  model.sections = {{"s", EA, 1.44e7, GA}};
  model.members = {{"column", "foot", "corner", "s", LineCurve{}, false, false},
                   {"beam", "corner", "end", "s", LineCurve{}, false, false}};
  model.supports = {{"foot", true, true, false, 0.0, {}}, {"end", true, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"", "beam", 0.2}, {0.0, -1000.0}, 0.0, Pattern::proportional}};
  return model;
}

/// Pinned column of length L along x, right end sliding, unit compression, bonded base K.
inline Model column(double length, double EI, double EA, double K) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", length, 0.0}};
  model.sections = {{"s", EA, EI, {}}};
  Member member;
  member.id = "column";
  member.start = "a";
  member.end = "b";
  member.section = "s";
  model.members = {member};
  model.supports = {{"a", true, true, false, 0.0, {}}, {"b", false, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {-1.0, 0.0}, 0.0, Pattern::proportional}};
  if (K > 0.0) {
    Foundation soil;
    soil.id = "soil";
    soil.member = "column";
    soil.stiffness = K;
    model.foundations = {soil};
  }
  model.monitors = {{"mid", {"", "column", 0.5}, Component::y}};
  return model;
}

inline Discretization fixed_mesh(int elements, int order, FoundationRule rule = FoundationRule::consistent) {
  Discretization d;
  d.fixed_mesh = true;
  d.elements = elements;
  d.order = order;
  d.foundation = rule;
  return d;
}

}  // namespace snapthrough::testing
