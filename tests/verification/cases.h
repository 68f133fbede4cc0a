#pragma once
/// @file
/// What the verification cases share: straight members, analyses on fixed meshes, and reading of results.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "solver/solve.h"
#include "tests/reaction_sum.h"
#include "tests/solver/structures.h"

namespace snapthrough::testing {

inline constexpr double kPi = std::numbers::pi;

inline Location at_node(const std::string& id) { return {id, "", 0.0}; }
inline Location at_member(const std::string& id, double fraction) { return {"", id, fraction}; }

inline Support support(const std::string& node, const std::string& fixed, double angle = 0.0) {
  Support s;
  s.node = node;
  s.x = fixed.find('x') != std::string::npos;
  s.y = fixed.find('y') != std::string::npos;
  s.rotation = fixed.find('r') != std::string::npos;
  s.angle_degrees = angle;
  return s;
}

inline PointLoad force_at(Location at, double fx, double fy, double moment = 0.0) {
  return {std::move(at), {fx, fy}, moment, Pattern::proportional};
}

inline Foundation winkler(const std::string& member, double K, double G = 0.0) {
  Foundation base;
  base.id = "soil";
  base.member = member;
  base.stiffness = K;
  base.shear_stiffness = G;
  return base;
}

inline Foundation one_sided(const std::string& member, double K, Side side) {
  Foundation base = winkler(member, K);
  base.reaction = Reaction::compression_only;
  base.side = side;
  return base;
}

/// Straight member "m" along x from node "a" at the origin to node "b"; ends as in support().
inline Model straight(double length, double EI, double EA, const std::string& start, const std::string& end) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", length, 0.0}};
  model.sections = {{"s", EA, EI, {}}};
  model.members = {{"m", "a", "b", "s", LineCurve{}, false, false}};
  if (!start.empty()) model.supports.push_back(support("a", start));
  if (!end.empty()) model.supports.push_back(support("b", end));
  return model;
}

/// An upright bar of length 1, almost rigid, on a hinge with a spring in rotation.
inline Model bar_on_spring(const ReactionLaw& law) {
  Model model;
  model.nodes = {{"foot", 0.0, 0.0}, {"head", 0.0, 1.0}};
  model.sections = {{"s", 1e13, 1e11, {}}};
  model.members = {{"m", "foot", "head", "s", LineCurve{}, false, false}};
  model.supports = {support("foot", "xy")};
  Spring spring;
  spring.id = "spring";
  spring.at = at_node("foot");
  spring.law = law;
  model.springs = {spring};
  return model;
}

inline Analysis analysis_of(AnalysisType type, Discretization mesh) {
  Analysis analysis;
  analysis.type = type;
  analysis.discretization = std::move(mesh);
  analysis.output.states = StateOutput::none;
  return analysis;
}

inline Discretization accurate(double accuracy) {
  Discretization mesh;
  mesh.accuracy = accuracy;
  return mesh;
}

inline Analysis buckling_on(Discretization mesh, int modes = 1) {
  Analysis analysis = analysis_of(AnalysisType::buckling, std::move(mesh));
  analysis.modes = modes;
  return analysis;
}

inline Analysis static_on(Discretization mesh, Geometry geometry, std::vector<double> factors = {1.0}) {
  Analysis analysis = analysis_of(AnalysisType::static_, std::move(mesh));
  analysis.geometry = geometry;
  analysis.output.states = StateOutput::all;
  analysis.load_factors = std::move(factors);
  return analysis;
}

inline Analysis path_on(Discretization mesh, int limit_points) {
  Analysis analysis = analysis_of(AnalysisType::path, std::move(mesh));
  analysis.stop.limit_points = limit_points;
  return analysis;
}

/// Solves and expects that nothing failed, and that what acts on the structure adds up to nothing.
inline Result solve_soundly(const Model& model, const Analysis& analysis) {
  for (const Finding& finding : check(model, analysis))
    ADD_FAILURE() << finding.pointer << ": " << finding.detail;
  Result result = solve(model, analysis);
  if (result.failure) ADD_FAILURE() << result.failure->code << ": " << result.failure->detail;
  for (const State& state : result.states)
    EXPECT_LT(reaction_sum(model, state, analysis.geometry).imbalance(), 1e-9) << state.load_factor;
  return result;
}

/// Limit points of a path in the order met.
inline std::vector<CriticalPoint> limits_of(const Result& result) {
  std::vector<CriticalPoint> out;
  for (const CriticalPoint& point : result.critical_points)
    if (is_limit(point.type)) out.push_back(point);
  return out;
}

inline std::vector<CriticalPoint> bifurcations_of(const Result& result) {
  std::vector<CriticalPoint> out;
  for (const CriticalPoint& point : result.critical_points)
    if (point.type == CriticalType::bifurcation) out.push_back(point);
  return out;
}

inline const MemberState& member_of(const State& state, const std::string& id) {
  const auto found = std::find_if(state.members.begin(), state.members.end(),
                                  [&id](const MemberState& m) { return m.id == id; });
  return *found;
}

/// The first load at which a structure is not stable, by a grid of loads up to `most` and by halving.
/// @param is_stable tells of a load whether the structure is stable there
/// @param tolerance relative width of the last interval
/// @return upper end of that interval; 0 where the structure is stable at every load of the grid
template <class IsStable>
double first_unstable_load(const IsStable& is_stable, double most, int loads, double tolerance) {
  double lo = 0.0;
  double hi = 0.0;
  for (int i = 1; i <= loads && hi == 0.0; ++i) {
    const double load = most * i / loads;
    (is_stable(load) ? lo : hi) = load;
  }
  while (hi - lo > tolerance * hi) {
    const double middle = 0.5 * (lo + hi);
    (is_stable(middle) ? lo : hi) = middle;
  }
  return hi;
}

inline void expect_relative(double value, double expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected)) << what;
}

}  // namespace snapthrough::testing
