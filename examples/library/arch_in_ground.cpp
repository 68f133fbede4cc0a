// The first limit load of a pinned shallow arch in ground that can only push, without JSON and without a service: the arch of
// examples/arch_outside_base_k1e7.json. Prints the load factor P R^2/EI and its error estimate.

#include <snapthrough/solver/check/check.h>
#include <snapthrough/solver/solve.h>

#include <cmath>
#include <iostream>

#include "arch_in_ground.h"

int main() {
  using namespace snapthrough;
  const Model model = arch_in_ground();
  Analysis analysis;
  analysis.type = AnalysisType::critical;
  for (const Finding& finding : check(model, analysis)) {
    std::cerr << finding.pointer << ": " << finding.detail << '\n';
  }
  const Result result = solve(model, analysis);
  if (result.failure || !result.summary.critical_load_factor) {
    std::cerr << result.summary.message << '\n';
    return 1;
  }
  std::cout.precision(8);
  std::cout << *result.summary.critical_load_factor << " +- "
            << *result.summary.critical_load_factor * result.summary.error_estimate.value_or(NAN) << '\n';
}
