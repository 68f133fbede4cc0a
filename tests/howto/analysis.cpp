/// Compiled against the solver with the blocks of docs/howto/add-an-analysis.md; see analysis.py.
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "solver/solve.h"
#include "tests/solver/structures.h"

int main() {
  using namespace snapthrough;
  // a bar of EA / l = 100 under the force -1: its end moves by u at the load factor -100 u
  Model model = testing::column(1.0, 1.0, 100.0, 0.0);
  model.monitors = {{"u", {"b", "", 0.0}, Component::x}};
  Analysis analysis;
  analysis.type = AnalysisType::reach;
  analysis.reached_monitor = "u";
  analysis.reached_values = {-0.01, -0.02, -0.05};
  const Result result = solve(model, analysis);
  if (!result.static_table || result.static_table->load_factor.size() != 3) return 1;
  bool right = !result.failure;
  for (std::size_t i = 0; i < 3; ++i) {
    const double exact = -100.0 * analysis.reached_values[i];
    std::printf("u = %g at load factor %.12g, exact %.12g\n", analysis.reached_values[i],
                result.static_table->load_factor[i], exact);
    right = right && std::abs(result.static_table->load_factor[i] - exact) < 1e-10;
  }
  return right ? 0 : 1;
}
