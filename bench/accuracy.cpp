/// Error, estimate and milliseconds of the first limit load at several accuracies, all in one run.
///
///   build/release/bench/bench_accuracy
///
/// Sources of the known loads: collocation of the boundary-value problems, 10 to 12 digits
/// (tests/verification/data). Times are medians of 21 solves on one core, with everything: meshes, path,
/// refinement and estimate; compare them within one run only.
#include <cmath>
#include <cstdio>
#include <string>

#include "bench/cases.h"
#include "bench/timing.h"

namespace {

using namespace snapthrough;

void measure(const bench::Case& problem) {
  double at_default = 0.0;
  for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-6}) {
    Result result;
    Analysis analysis = problem.analysis;
    analysis.discretization.accuracy = accuracy;
    const double time = bench::median_milliseconds(problem.model, analysis, result);
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
  for (const char* name :
       {"shallow_arch", "shallow_arch_k1e7", "shallow_arch_k1e9", "deep_arch", "ring_k1200", "ring_k180000"})
    measure(bench::case_named(name));
}
