#include "solver/analysis/observer.h"

#include <cmath>
#include <string>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/numeric/number_text.h"
#include "solver/report/extremes.h"
#include "solver/report/state.h"

namespace snapthrough {

void Observer::note_stress(const Eigen::VectorXd& y, double lambda, int branch) {
  if (!has_strength_) return;
  const auto here = largest_utilisation(structure_, y, lambda);
  if (!here || (stressed_ && std::abs(here->place.value) <= std::abs(stressed_->place.value))) return;
  stressed_ = here;
  stressed_branch_ = branch;
  stressed_load_ = lambda / structure_.scales.load;
}

/// Says that answers beyond first yield are those of an elastic structure.
void Observer::warn_of_stress(Result& result) const {
  std::string text;
  if (stressed_ && std::abs(stressed_->place.value) > 1.0)
    text = "the stress reaches " + rounded(std::abs(stressed_->place.value)) +
           " of the strength in member \"" + stressed_->member + "\" at s = " + rounded(stressed_->place.s) +
           ", load factor " + number(stressed_load_) + " on branch " + std::to_string(stressed_branch_);
  if (result.first_yield)
    text += (text.empty() ? "the stress" : "; it") +
            std::string(" first reaches the strength at load factor ") +
            number(result.first_yield->load_factor);
  if (text.empty()) return;
  result.warnings.push_back(
      {"beyond_yield", text + ": beyond, the answers are those of an elastic structure"});
}

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
  warn_of_stress(result);
  if (largest_.strain <= StrainLimits::small) return;
  result.warnings.push_back(
      {"large_strain", "the strain reaches " + rounded(largest_.strain) + " in member \"" + largest_.member +
                           "\" at s = " + rounded(largest_.s) + ", load factor " + number(strained_load_) +
                           " on branch " + std::to_string(strained_branch_) + ": beyond " +
                           rounded(StrainLimits::small) + " the linear law of the sections does not hold"});
}

}  // namespace snapthrough
