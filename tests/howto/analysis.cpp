/// Compiled against the solver with the blocks of docs/howto/add-an-analysis.md; see analysis.py.
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "solver/solve.h"

int main() {
  using namespace snapthrough;
  // a bar of EA / l = 100 under a force of 4: its end moves by u at the load factor 25 u
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}};
  Section section;
  section.id = "s";
  section.EA = 100.0;
  section.EI = 1.0;
  model.sections = {section};
  Member member;
  member.id = "m";
  member.start = "a";
  member.end = "b";
  member.section = "s";
  model.members = {member};
  Support held;
  held.node = "a";
  held.x = held.y = held.rotation = true;
  Support guided;
  guided.node = "b";
  guided.y = guided.rotation = true;
  model.supports = {held, guided};
  model.loads = {PointLoad{{"b", "", 0.0}, {4.0, 0.0}, 0.0, Pattern::proportional}};
  Monitor monitor;
  monitor.id = "u";
  monitor.at.node = "b";
  monitor.component = Component::x;
  model.monitors = {monitor};
  Analysis analysis;
  analysis.type = AnalysisType::reach;
  analysis.reached_monitor = "u";
  analysis.reached_values = {0.01, 0.02, 0.05};
  const Result result = solve(model, analysis);
  if (!result.static_table || result.static_table->load_factor.size() != 3) return 1;
  bool right = !result.failure;
  for (std::size_t i = 0; i < 3; ++i) {
    const double exact = 25.0 * analysis.reached_values[i];
    std::printf("u = %g at load factor %.12g, exact %.12g\n", analysis.reached_values[i],
                result.static_table->load_factor[i], exact);
    right = right && std::abs(result.static_table->load_factor[i] - exact) < 1e-10;
  }
  return right ? 0 : 1;
}
