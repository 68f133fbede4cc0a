// The first limit load of a pinned shallow arch in ground that can only push, without JSON and without a service: the arch of
// examples/arch_outside_base_k1e7.json. Prints the load factor P R^2/EI and its error estimate.

#include <cmath>
#include <iostream>
#include <numbers>

#include "solver/check/check.h"
#include "solver/solve.h"

namespace {

using namespace snapthrough;

Model arch_in_ground() {
  constexpr double kRadius = 100.0;
  constexpr double kEI = 1.4;
  const double half_span = kRadius * std::sin(10.0 * std::numbers::pi / 180.0);
  Model model;
  model.nodes = {{.id = "left", .x = -half_span, .y = 0.0}, {.id = "right", .x = half_span, .y = 0.0}};
  model.sections = {{.id = "rib", .EA = 300.0 * kEI, .EI = kEI, .GA = {}}};
  model.members = {{.id = "arch", .start = "left", .end = "right", .section = "rib", .curve = ArcCurve{-20.0}}};
  model.supports = {{.node = "left", .x = true, .y = true, .displacement = {}},
                    {.node = "right", .x = true, .y = true, .displacement = {}}};
  model.foundations = {{.id = "ground", .member = "arch", .stiffness = 1e7 * kEI / std::pow(kRadius, 4),
                        .reaction = Reaction::compression_only, .side = Side::left, .direction = {}}};
  const Location crown{.node = {}, .member = "arch", .fraction = 0.5};
  model.loads = {PointLoad{.at = crown, .force = {0.0, -kEI / (kRadius * kRadius)}}};
  return model;
}

}  // namespace

int main() {
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
