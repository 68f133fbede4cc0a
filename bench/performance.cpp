/// Time against error, unknowns and what was asked for, by Google Benchmark; scripts/bench.sh makes tables
/// and plots of it. Everything is counted: meshes, path, refinement and estimate. Compare times within one
/// run only.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "bench/cases.h"
#include "bench/kernels.h"
#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough::bench {
namespace {

/// The load that the case is about.
double found_load(const Result& result) {
  if (result.buckling) return result.summary.critical_load_factor.value_or(NAN);
  return result.critical_points.empty() ? NAN : result.critical_points.back().load_factor;
}

void run(benchmark::State& state, const Case& c) {
  Result result;
  for (auto unused : state) {
    (void)unused;
    result = solve(c.model, c.analysis);
    benchmark::DoNotOptimize(result);
  }
  if (c.load != 0.0) state.counters["error"] = std::abs(found_load(result) / c.load - 1.0);
  if (c.target_ms > 0.0) state.counters["target_ms"] = c.target_ms;
  if (!result.critical_points.empty())
    state.counters["estimate"] = result.critical_points.back().error_estimate.value_or(NAN);
  state.counters["unknowns"] = result.discretization.unknowns;
  state.counters["elements"] = result.discretization.elements;
  state.counters["order"] = result.discretization.order;
  state.counters["factorizations"] = result.diagnostics.factorizations;
  state.counters["steps"] = result.diagnostics.steps;
}

void add(const std::string& name, const Case& c) {
  benchmark::RegisterBenchmark(name.c_str(), [c](benchmark::State& state) {
    run(state, c);
  })->Unit(benchmark::kMillisecond);
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0e", value);
  return text;
}

void add_accuracies() {
  for (Case c : cases()) {
    for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      c.analysis.discretization.accuracy = accuracy;
      add("accuracy/" + c.name + "/" + number(accuracy), c);
    }
  }
  add("accuracy/column_with_spring/1e-03", column_with_spring());
}

/// Fixed meshes of several orders.
void add_meshes() {
  for (Case c : cases()) {
    for (const int order : {1, 2, 3, 4, 5, 6}) {
      for (const int elements : {4, 8, 16, 32, 64, 128}) {
        if (elements * order < 12 || elements * order > (order == 1 ? 128 : 96)) continue;
        c.analysis.discretization = testing::fixed_mesh(elements, order);
        add("mesh/" + c.name + "/" + std::to_string(order) + "/" + std::to_string(elements), c);
      }
    }
  }
}

void add_growth() {
  for (const int elements : {10, 30, 100, 300, 1000, 3000, 10000, 30000, 100000})
    add("growth/" + std::to_string(elements), growing_arch(elements));
  for (const int pieces : {1, 2, 4, 8, 16, 32})
    add("bases/" + std::to_string(pieces), arch_on_pieces(pieces));
}

/// Pairs that differ in one thing that need not be done.
void add_skips() {
  Case c = case_named("shallow_arch_k1e7");
  add("skip/path_without_states", c);
  c.analysis.output.states = StateOutput::critical;
  add("skip/path_with_critical_states", c);
  c.analysis.output.states = StateOutput::all;
  add("skip/path_with_all_states", c);
  c.analysis.output.states = StateOutput::none;
  c.analysis.type = AnalysisType::critical;
  add("skip/critical_load_only", c);
  Case deep = case_named("deep_arch");
  add("skip/first_limit_point_by_path", deep);
  deep.analysis.type = AnalysisType::critical;
  add("skip/first_limit_point_alone", deep);
  Case column = case_named("column");
  add("skip/straight_by_path", column);
  column.analysis.type = AnalysisType::buckling;
  add("skip/straight_linearised", column);
  c.load = 0.0;
  c.target_ms = 0.0;
  c.model.foundations[0].reaction = Reaction::bilateral;
  c.analysis.discretization = testing::fixed_mesh(12, 5);
  c.analysis.type = AnalysisType::path;
  c.analysis.stop = {};
  c.analysis.stop.steps = 6;
  add("skip/base_bilateral", c);
  c.model.foundations[0].reaction = Reaction::compression_only;
  add("skip/base_one_sided", c);
  c.model.foundations[0].reaction = Reaction::bilateral;
  c.model.foundations[0].stiffness = 1e-12;
  add("skip/base_of_tiny_stiffness", c);
  c.model.foundations[0].stiffness = 0.0;
  add("skip/base_of_stiffness_0", c);
  c.model.foundations.clear();
  add("skip/no_base", c);
}

}  // namespace
}  // namespace snapthrough::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  snapthrough::bench::add_accuracies();
  snapthrough::bench::add_meshes();
  snapthrough::bench::add_growth();
  snapthrough::bench::add_skips();
  snapthrough::bench::add_kernels();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
