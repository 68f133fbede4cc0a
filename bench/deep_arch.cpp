/// Error of the first limit load of the 215-degree clamped-hinged arch (EA = 1e8, EI = 1e6, R = 100) against
/// unknowns and milliseconds, for several orders and numbers of elements, all in one run.
///
///   build/release/bench/bench_deep_arch
///
/// Reference: 8.97294947594 P R^2 / EI, collocation of the boundary-value problem (EA R^2 / EI = 1e6,
/// unshearable). Times are medians of 21 solves on one core, the mesh and everything else included; compare
/// them within one run only.
#include <cmath>
#include <cstdio>

#include "bench/cases.h"
#include "bench/timing.h"

namespace {

using namespace snapthrough;

void measure(const bench::Case& arch, int elements, int order) {
  Analysis analysis = arch.analysis;
  analysis.discretization.fixed_mesh = true;
  analysis.discretization.elements = elements;
  analysis.discretization.order = order;
  Result result;
  const double time = bench::median_milliseconds(arch.model, analysis, result);
  const double load = result.critical_points.empty() ? NAN : result.critical_points.back().load_factor;
  std::printf("| %d | %d | %d | %.9f | %.1e | %d | %d | %.2f |\n", order, elements,
              result.discretization.unknowns, load, std::abs(load / arch.load - 1.0),
              result.diagnostics.steps, result.diagnostics.factorizations, time);
}

}  // namespace

int main() {
  const bench::Case arch = bench::case_named("deep_arch");
  std::printf(
      "| order | elements | unknowns | limit load | relative error | steps | factorisations | ms |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const int elements : {32, 64, 128, 256}) measure(arch, elements, 1);
  for (const int elements : {16, 32, 64}) measure(arch, elements, 2);
  for (const int elements : {8, 16, 32}) measure(arch, elements, 3);
  for (const int elements : {6, 10, 16}) measure(arch, elements, 4);
  for (const int elements : {4, 8, 12}) measure(arch, elements, 5);
  for (const int elements : {4, 6, 8}) measure(arch, elements, 6);
}
