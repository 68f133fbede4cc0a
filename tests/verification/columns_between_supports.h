#pragma once
/// @file
/// Straight columns of length 1 with EI = 1, drawn in any way, and analyses of them.

#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough::testing {

/// Axial shortening changes closed forms by P / EA.
inline constexpr double kColumnEA = 1e9;

/// From the origin at an angle, in members m1, m2, ... that end at the fractions, at nodes 1, 2, ...;
/// supports in the column's own axes.
inline Model drawn_column(double degrees, const std::vector<double>& ends = {1.0},
                          const std::string& start = "xy", const std::string& end = "y") {
  const double angle = degrees * kPi / 180.0;
  const std::array<double, 2> along{std::cos(angle), std::sin(angle)};
  Model model;
  model.sections = {{"s", kColumnEA, 1.0, {}}};
  model.nodes = {{"0", 0.0, 0.0}};
  for (const double to : ends) {
    const std::string number = std::to_string(model.nodes.size());
    model.members.push_back({"m" + number, model.nodes.back().id, number, "s", LineCurve{}, false, false});
    model.nodes.push_back({number, to * along[0], to * along[1]});
  }
  model.supports = {support("0", start, degrees), support(model.nodes.back().id, end, degrees)};
  model.loads = {force_at(at_node(model.nodes.back().id), -along[0], -along[1])};
  return model;
}

/// Left normal of a column at an angle.
inline std::array<double, 2> normal_at(double degrees) {
  return {-std::sin(degrees * kPi / 180.0), std::cos(degrees * kPi / 180.0)};
}

inline Foundation side_base(const std::string& member, double K, Side side,
                            std::array<double, 2> range = {0.0, 1.0}) {
  Foundation base = one_sided(member, K, side);
  base.range = range;
  return base;
}

/// A spring that pushes against movement along `sign` times `direction`.
inline Spring side_spring(Location at, std::array<double, 2> direction, double sign, double stiffness,
                          Reaction reaction = Reaction::compression_only) {
  return {"", std::move(at), std::array{sign * direction[0], sign * direction[1]}, stiffness, reaction, 0.0};
}

/// Supports get their numbers as ids.
inline Model numbered(Model model) {
  for (std::size_t i = 0; i < model.springs.size(); ++i) model.springs[i].id = std::to_string(i);
  for (std::size_t i = 0; i < model.foundations.size(); ++i) model.foundations[i].id = std::to_string(i);
  return model;
}

inline Discretization chosen_mesh(double accuracy) {
  Discretization mesh;
  mesh.accuracy = accuracy;
  return mesh;
}

inline double first_load(const Model& model, AnalysisType type, const Discretization& mesh) {
  const Result result = solve_soundly(numbered(model), analysis_of(type, mesh));
  EXPECT_TRUE(result.summary.critical_load_factor) << result.summary.message;
  return result.summary.critical_load_factor.value_or(0.0);
}

/// By the path, by the linearised problem on a fixed mesh, and by that on a chosen one (or without a mesh).
inline void expect_first_loads(const Model& model, double expected, const std::string& what) {
  const double shortening = 2.0 * expected / kColumnEA;
  const struct {
    AnalysisType type;
    Discretization mesh;
    double error;
  } ways[] = {{AnalysisType::critical, chosen_mesh(1e-6), 1e-6},
              {AnalysisType::buckling, fixed_mesh(12, 6), 1e-8},
              {AnalysisType::buckling, chosen_mesh(1e-6), 1e-6}};
  for (const auto& way : ways)
    expect_relative(first_load(model, way.type, way.mesh), expected, way.error + shortening, what);
}

/// Pinned, on a bilateral Winkler base: P = min_n (n^2 pi^2 + K / (n^2 pi^2)).
inline double pinned_on_bilateral(double K) {
  double least = 1e300;
  for (int n = 1; n <= 60; ++n) least = std::min(least, n * n * kPi * kPi + K / (n * n * kPi * kPi));
  return least;
}

}  // namespace snapthrough::testing
