// The equilibrium path of the arch of arch_in_ground.cpp: watched while it is traced, ended by a condition of the program's own, and
// with the bending moments of the arch at the first limit point. Prints three lines.

#include <snapthrough/solver/check/check.h>
#include <snapthrough/solver/solve.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stop_token>

#include "arch_in_ground.h"

int main() {
  using namespace snapthrough;
  Model model = arch_in_ground();
  model.monitors = {{.id = "crown", .at = {.node = {}, .member = "arch", .fraction = 0.5}, .component = Component::y}};
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.output.states = StateOutput::critical;
  if (!check(model, analysis).empty()) {
    return 1;
  }

  // Hooks are called on the thread of solve(). A path that is stopped has all points up to then.
  std::stop_source stop;
  Hooks hooks{.stop = stop.get_token()};
  hooks.on_point = [&](const TracedPoint& point) {
    if (point.monitors.front().value < -2.0) {  // the crown is 2 below its place
      stop.request_stop();
    }
  };
  int found = 0;
  hooks.on_critical = [&](const CriticalPoint& /*point*/) { ++found; };
  const Result result = solve(model, analysis, hooks);

  const bool stopped = result.failure && result.failure->code == "cancelled";
  if ((result.failure && !stopped) || result.branches.empty() || result.states.empty()) {
    std::cerr << result.summary.message << '\n';
    return 1;
  }
  const Branch& path = result.branches.front();
  std::cout << path.load_factor.size() << " points, " << found << " critical points met, "
            << (stopped ? "stopped" : "ended by itself") << '\n';
  std::cout.precision(8);
  std::cout << "first limit load " << result.critical_points.front().load_factor << '\n';
  const std::vector<double>& moments = result.states.front().members.front().bending_moment;
  const double largest = *std::max_element(moments.begin(), moments.end(),
                                           [](double a, double b) { return std::abs(a) < std::abs(b); });
  std::cout << "largest bending moment there " << largest << '\n';
}
