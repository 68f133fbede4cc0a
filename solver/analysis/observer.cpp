#include "solver/analysis/observer.h"

#include <string>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/numeric/number_text.h"
#include "solver/report/extremes.h"
#include "solver/report/state.h"

namespace snapthrough {

void Observer::note(const Eigen::VectorXd& y, double lambda, int branch) {
  peaks_.note(y, lambda / structure_.scales.load);
  if (!gauge_.raise(y, largest_)) return;
  strained_branch_ = branch;
  strained_load_ = lambda / structure_.scales.load;
}

void Observer::add_to_extremes(const Eigen::VectorXd& y, double lambda, int branch) {
  if (!analysis_.output.extremes) return;
  widen_extremes(member_states(structure_, y, lambda, analysis_.output.points_per_member), branch,
                 lambda / structure_.scales.load, extremes_);
}

void Observer::finish(Result& result) {
  if (analysis_.output.extremes) {
    for (const State& state : result.states)
      widen_extremes(state.members, state.branch, state.load_factor, extremes_);
    result.extremes = std::move(extremes_);
  }
  if (!peaks_.text().empty()) {
    result.warnings.push_back(
        {"unloaded_beyond_peak",
         "supports or joints went back from beyond the peak of their law: " + peaks_.text() +
             "; a law is elastic, so that they regain along its curve what they had lost"});
  }
  if (largest_.strain <= StrainLimits::small) return;
  result.warnings.push_back(
      {"large_strain", "the strain reaches " + rounded(largest_.strain) + " in member \"" + largest_.member +
                           "\" at s = " + rounded(largest_.s) + ", load factor " + number(strained_load_) +
                           " on branch " + std::to_string(strained_branch_) + ": beyond " +
                           rounded(StrainLimits::small) + " the linear law of the sections does not hold"});
}

}  // namespace snapthrough
