#include "solver/analysis/path_states.h"

#include <cstddef>
#include <string>
#include <utility>

#include "solver/numeric/number_text.h"
#include "solver/report/state.h"
#include "solver/report/support_state.h"

namespace snapthrough {
namespace {

bool is_balanced(const RefinedStates& refined) {
  const StaticState& at = refined.states.front();
  return imbalance(*refined.structure, at.y, at.lambda) <= StateLimits::imbalance;
}

/// Replaces a state by that of a finer mesh.
void replace(const Analysis& analysis, const RefinedStates& refined, State& state) {
  const StaticState& at = refined.states.front();
  State finer = make_state(*refined.structure, at.y, at.lambda, analysis.output);
  finer.branch = state.branch;
  finer.load_factor = state.load_factor;
  finer.refinements = refined.refinements;
  state = std::move(finer);
}

}  // namespace

void refine_path_states(const Analysis& analysis, const Structure& structure,
                        const std::vector<StaticState>& states, const std::stop_token& stop, Result& result) {
  std::string doubts;
  std::size_t doubtful = 0;
  for (const StaticState& asked : states) {
    if (stop.stop_requested()) return;
    const RefinedStates refined = refine_states(analysis.discretization, structure, {asked}, no_other_states);
    result.diagnostics.factorizations += refined.factorizations;
    State& state = result.states[asked.row];
    // a state that stays was judged when it was recorded
    const bool is_finer = refined.refinements > 0;
    const bool is_confirmed = refined.error && *refined.error <= analysis.discretization.accuracy &&
                              (!is_finer || is_balanced(refined));
    if (is_confirmed && is_finer) replace(analysis, refined, state);
    if (is_confirmed) {
      state.error_estimate = refined.error;
      continue;
    }
    ++doubtful;
    doubts += (doubts.empty() ? "" : ", ") + number(state.load_factor);
  }
  if (doubtful == 0) return;
  result.warnings.push_back(
      {"state_accuracy", std::to_string(doubtful) + " of " + std::to_string(states.size()) +
                             " states at load factors are not confirmed by finer meshes: " + doubts});
}

}  // namespace snapthrough
