#include "solver/analysis/branch_follower.h"

#include <cstddef>

#include "solver/analysis/path_messages.h"
#include "solver/analysis/path_rules.h"
#include "solver/events/branch.h"

namespace snapthrough {
namespace {

/// Limits of branches where the request has none. Chosen; docs/requests.md tells the first.
struct BranchLimits {
  static constexpr int most = 20;             ///< branches that are followed
  static constexpr double first_step = 0.02;  ///< arc length
};

}  // namespace

BranchFollower::BranchFollower(const Analysis& analysis, const Structure& structure, PathFollower& follower,
                               Recorder& recorder, CriticalLoads& loads, MonitorWatch& watch,
                               const Hooks& hooks)
    : analysis_(analysis),
      rules_(rules_of(analysis, structure)),
      follower_(follower),
      recorder_(recorder),
      loads_(loads),
      watch_(watch),
      hooks_(hooks),
      limit_(analysis.branches.limit.value_or(
          analysis.branches.follow == Follow::first ? 2 : BranchLimits::most)) {}

void BranchFollower::add(const TraceOutcome& outcome, int branch) {
  for (const CriticalEvent& event : outcome.critical) {
    if (event.type != CriticalType::bifurcation || grows_from(event)) continue;
    if (analysis_.branches.follow == Follow::first && !pending_.empty()) return;
    for (const double sign : {1.0, -1.0}) pending_.push_back({event, branch, sign});
    rules_.known.push_back(event.point);
  }
}

bool BranchFollower::follow(const Pending& pending) {
  const auto first = first_point_of_branch(follower_, pending.at, pending.sign);
  if (!first) return false;
  const int id = ++branches_;
  recorder_.begin_branch(id, pending.parent);
  PathPoint origin = pending.at.point;
  origin.arc_length = 0.0;
  origin.tangent.resize(0);  // the branch's tangent is not that of its parent
  recorder_.add_point(origin);
  TraceRules rules = rules_;
  rules.first_step = BranchLimits::first_step;
  bound_negative(analysis_, first->negative, watch_, rules);
  rules.finer_imperfection = [this](const CriticalEvent& event) { return loads_.finer_imperfection(event); };
  recorder_.ask(rules);
  const TraceOutcome outcome =
      trace(follower_, first, rules, analysis_.step, {&watch_, &recorder_, &loads_}, hooks_.stop);
  recorder_.end_branch(code_of(outcome.end));
  if (outcome.end == TraceEnd::rejoined) ++rejoined_;
  if (analysis_.branches.follow == Follow::all) add(outcome, id);
  return true;
}

std::string BranchFollower::run() {
  std::size_t next = 0;
  for (; next < pending_.size() && branches_ < limit_ && !hooks_.stop.stop_requested(); ++next)
    if (!follow(Pending(pending_[next]))) ++lost_;
  std::string text = "; followed " + std::to_string(branches_) + " branches";
  if (rejoined_ > 0) text += ", " + std::to_string(rejoined_) + " of them back to a known bifurcation";
  if (lost_ > 0) text += ", found no way onto " + std::to_string(lost_);
  if (next < pending_.size())
    text += ", left out " + std::to_string(pending_.size() - next) + " beyond the limit";
  return text;
}

}  // namespace snapthrough
