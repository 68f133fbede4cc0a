#pragma once
/// @file
/// A request without mistakes that tests spoil in one place each.

#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::testing {

struct SoundRequest {
  Model model;
  Analysis analysis;
};

/// Two collinear members on three nodes, pinned left, sliding right, on a base, with a spring, loads, a sine
/// imperfection and monitors; a path on a fixed mesh. Only what every version of the solver supports.
inline SoundRequest sound_request() {
  SoundRequest request;
  Model& m = request.model;
  m.nodes = {{"a", 0.0, 0.0}, {"b", 2.0, 0.0}, {"c", 5.0, 0.0}};
  m.sections = {{"steel", 1e4, 10.0, 4e3}};
  m.members = {{"ab", "a", "b", "steel", LineCurve{}}, {"bc", "b", "c", "steel", ArcCurve{-30.0}}};
  m.supports = {{"a", true, true, false, 0.0, {}}, {"c", false, true, false, 0.0, {}}};
  m.springs = {{"s1", {"", "bc", 0.5}, {{0.0, 1.0}}, 5.0, Reaction::compression_only, 0.01}};
  m.foundations = {{"soil", "ab", 3.0, 0.0, Reaction::compression_only, Side::left, {0.0, 0.5}, 0.001, {}}};
  m.loads = {PointLoad{{"c", "", 0.0}, {-1.0, 0.0}, 0.0, Pattern::proportional},
             DistributedLoad{"ab", {0.0, -0.1}, {0.25, 1.0}, LoadMeasure::length, Pattern::proportional}};
  m.imperfections = {SineImperfection{"ab", 1, 1e-4}};
  m.monitors = {{"mid", {"", "ab", 0.5}, Component::normal}, {"tip", {"c", "", 0.0}, Component::x}};
  Analysis& a = request.analysis;
  a.type = AnalysisType::path;
  a.discretization.fixed_mesh = true;
  a.discretization.elements = 8;
  a.discretization.order = 2;
  a.step.initial = 0.1;
  a.step.min = 1e-6;
  a.step.max = 0.2;
  a.stop.limit_points = 1;
  a.stop.load_factor = {0.0, 100.0};
  a.stop.monitor = {"mid", {-1.0, 1.0}};
  a.stop.steps = 100;
  return request;
}

}  // namespace snapthrough::testing
