/// Error, estimate and milliseconds of the first limit load at several accuracies, all in one run.
///
///   build/release/bench/bench_accuracy
///
/// Sources of the known loads: collocation of the boundary-value problems, 10 to 12 digits
/// (tests/verification/data). Times are medians of 21 solves on one core, with everything: meshes, path,
/// refinement and estimate; compare them within one run only.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace {

using namespace snapthrough;

struct Problem {
  std::string name;
  Model model;
  double load = 0.0;
};

Problem shallow_arch(double k, double load) {
  Problem problem{"shallow arch, base k = " + std::to_string(static_cast<long long>(k)),
                  testing::arch(20.0, 420.0, 1.4), load};
  if (k > 0.0) testing::add_soil(problem.model, k);
  return problem;
}

/// Half a ring in a medium outside, under its weight.
Problem ring(double k, double load) {
  constexpr double kRadius = 10.0;
  constexpr double kEI = 30e3;
  Problem problem{"ring, medium k = " + std::to_string(static_cast<long long>(k)), {}, load};
  Model& model = problem.model;
  model.nodes = {{"bottom", 0.0, -kRadius}, {"top", 0.0, kRadius}};
  model.sections = {{"s", 36e6, kEI, {}}};
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
  return problem;
}

Analysis first_limit_point(double accuracy) {
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.stop.limit_points = 1;
  analysis.output.states = StateOutput::none;
  analysis.discretization.accuracy = accuracy;
  return analysis;
}

double milliseconds(const Model& model, const Analysis& analysis, Result& result) {
  std::vector<double> times;
  for (int run = 0; run < 21; ++run) {
    const auto start = std::chrono::steady_clock::now();
    result = solve(model, analysis);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + 10, times.end());
  return times[10];
}

void measure(const Problem& problem) {
  double at_default = 0.0;
  for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-6}) {
    Result result;
    const double time = milliseconds(problem.model, first_limit_point(accuracy), result);
    if (accuracy == 1e-3) at_default = time;
    const CriticalPoint& point = result.critical_points.back();
    const std::string ratio = at_default > 0.0 ? std::to_string(time / at_default).substr(0, 4) : "";
    std::printf("| %s | %.0e | %.1e | %.1e | %d of order %d | %d | %d | %.2f | %s |\n", problem.name.c_str(),
                accuracy, std::abs(point.load_factor / problem.load - 1.0),
                point.error_estimate.value_or(NAN), result.discretization.elements,
                result.discretization.order, result.discretization.refinements,
                result.diagnostics.factorizations, time, ratio.c_str());
  }
}

}  // namespace

int main() {
  std::printf(
      "| first limit load | accuracy | error | estimate | elements | refinements | factorisations | ms | "
      "times that at 1e-3 |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Problem& problem :
       {shallow_arch(0.0, 76.1493461733), shallow_arch(1e7, 93.1178142194), shallow_arch(1e9, 102.9341234421),
        Problem{"deep arch, 215 degrees", testing::arch(215.0, 1e8, 1e6, true), 8.97294947594},
        ring(1200.0, 13.626899644), ring(180000.0, 65.729726832)})
    measure(problem);
}
