/// Error of the first limit load of the 215-degree clamped-hinged arch (EA = 1e8, EI = 1e6, R = 100) against
/// unknowns and milliseconds, for several orders and numbers of elements, all in one run.
///
///   build/release/bench/bench_deep_arch
///
/// Reference: 8.97294947594 P R^2 / EI, collocation of the boundary-value problem (EA R^2 / EI = 1e6,
/// unshearable). Times are medians of 21 solves on one core, the mesh and everything else included; compare
/// them within one run only.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "solver/solve.h"

namespace {

using namespace snapthrough;

constexpr double kReference = 8.97294947594;

Model deep_arch() {
  const double half = 107.5 * std::numbers::pi / 180.0;
  Model model;
  model.nodes = {{"a", -100.0 * std::sin(half), 0.0}, {"b", 100.0 * std::sin(half), 0.0}};
  model.sections = {{"s", 1e8, 1e6, {}}};
  model.members = {Member{"arch", "a", "b", "s", ArcCurve{-215.0}, false, false}};
  model.supports = {{"a", true, true, true, 0.0, {}}, {"b", true, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"", "arch", 0.5}, {0.0, -100.0}, 0.0, Pattern::proportional}};
  return model;
}

Analysis first_limit_point(int elements, int order) {
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.stop.limit_points = 1;
  analysis.output.states = StateOutput::none;
  analysis.discretization.fixed_mesh = true;
  analysis.discretization.elements = elements;
  analysis.discretization.order = order;
  return analysis;
}

void measure(const Model& model, int elements, int order) {
  const Analysis analysis = first_limit_point(elements, order);
  std::vector<double> times;
  Result result;
  for (int run = 0; run < 21; ++run) {
    const auto start = std::chrono::steady_clock::now();
    result = solve(model, analysis);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + 10, times.end());
  const double load = result.critical_points.empty() ? NAN : result.critical_points.back().load_factor;
  std::printf("| %d | %d | %d | %.9f | %.1e | %d | %d | %.2f |\n", order, elements,
              result.discretization.unknowns, load, std::abs(load / kReference - 1.0),
              result.diagnostics.steps, result.diagnostics.factorizations, times[10]);
}

}  // namespace

int main() {
  const Model model = deep_arch();
  std::printf(
      "| order | elements | unknowns | limit load | relative error | steps | factorisations | ms |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const int elements : {32, 64, 128, 256}) measure(model, elements, 1);
  for (const int elements : {16, 32, 64}) measure(model, elements, 2);
  for (const int elements : {8, 16, 32}) measure(model, elements, 3);
  for (const int elements : {6, 10, 16}) measure(model, elements, 4);
  for (const int elements : {4, 8, 12}) measure(model, elements, 5);
  for (const int elements : {4, 6, 8}) measure(model, elements, 6);
}
