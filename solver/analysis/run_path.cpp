#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "solver/accuracy/critical_loads.h"
#include "solver/analysis/analyses.h"
#include "solver/analysis/recorder.h"
#include "solver/analysis/skipped.h"
#include "solver/path/trace.h"
#include "solver/stability/branch.h"

namespace snapthrough {
namespace {

/// A search for the loss of stability has no bound that its user can choose: only a path that gets nowhere
/// meets this one.
constexpr int kMostStepsOfSearch = 20000;

const SparseRow* row_of(const Structure& structure, const std::string& monitor) {
  const auto found = std::find_if(structure.monitors.begin(), structure.monitors.end(),
                                  [&monitor](const MonitorRow& m) { return m.id == monitor; });
  return &found->row;
}

TraceRules rules_of(const Analysis& analysis, const Structure& structure) {
  TraceRules rules;
  // a fixed mesh is read to the last digit, a chosen one to a small part of the accuracy that was asked for
  rules.tolerance =
      analysis.discretization.fixed_mesh ? 1e-9 : std::min(1e-7, 1e-3 * analysis.discretization.accuracy);
  if (analysis.type == AnalysisType::critical) {
    rules.first_loss_of_stability = true;
    rules.steps = kMostStepsOfSearch;
    return rules;
  }
  const StopRules& stop = analysis.stop;
  rules.limit_points = stop.limit_points;
  if (stop.steps) rules.steps = *stop.steps;
  if (stop.load_factor)
    rules.load = {
        {(*stop.load_factor)[0] * structure.scales.load, (*stop.load_factor)[1] * structure.scales.load}};
  if (stop.monitor) {
    const SparseRow* row = row_of(structure, stop.monitor->id);
    rules.monitor = [row](const PathPoint& at) { return row->dot(at.y); };
    rules.monitor_range = stop.monitor->range;
  }
  if (analysis.control.type == ControlType::load) rules.limit_points = 1;
  if (analysis.control.type == ControlType::displacement) {
    const SparseRow* row = row_of(structure, analysis.control.monitor);
    rules.monitor_turns = true;
    rules.monitor_rate = [row](const PathPoint& at) { return row->dot(at.tangent); };
  }
  return rules;
}

/// Where the path's points are not returned as states they need not be equilibria to rounding: those of a
/// chosen mesh are the path's to a small part of the accuracy asked for.
ContinuationOptions options_of(const Analysis& analysis) {
  ContinuationOptions options;
  if (points_are_not_polished(analysis))
    options.corrector.tangent_tolerance = std::min(1e-4, 10.0 * analysis.discretization.accuracy);
  return options;
}

const char* name_of(CriticalType type) {
  switch (type) {
    case CriticalType::bifurcation:
      return "bifurcation";
    case CriticalType::limit_max:
      return "limit point (maximum)";
    case CriticalType::limit_min:
      return "limit point (minimum)";
  }
  return "";
}

/// Code of the result's `termination` and what it means.
struct EndText {
  TraceEnd end;
  const char* code;
  const char* text;
  bool failure;
};

constexpr EndText kEnds[] = {
    {TraceEnd::critical_point, "critical_point", "first loss of stability", false},
    {TraceEnd::unstable_at_start, "unstable_at_start", "the structure is unstable before the load grows",
     false},
    {TraceEnd::limit_points, "limit_points", "the last of the asked limit points was reached", false},
    {TraceEnd::load_factor, "load_factor", "the load factor left its range", false},
    {TraceEnd::monitor, "monitor", "the monitor reached the end of its range", false},
    {TraceEnd::monitor_turned, "monitor_turned", "the controlled displacement turns back here", false},
    {TraceEnd::rejoined, "rejoined", "the path came back to a known bifurcation", false},
    {TraceEnd::steps, "steps", "the path was still going on", false},
    {TraceEnd::displacement_bound, "displacement_bound", "displacements grew beyond any bound of interest",
     false},
    {TraceEnd::load_bound, "load_bound", "the load grew beyond any bound of interest", false},
    {TraceEnd::cancelled, "cancelled", "cancelled", true},
    {TraceEnd::step_underflow, "step_underflow", "no smaller step converged; the path stands", true},
    {TraceEnd::no_start, "no_start", "no equilibrium was found for the first small load", true}};

const EndText& text_of(TraceEnd end) {
  return *std::find_if(std::begin(kEnds), std::end(kEnds), [end](const EndText& e) { return e.end == end; });
}

void describe_end(const Analysis& analysis, const TraceOutcome& outcome, const Structure& structure,
                  Result& result) {
  const EndText* end = &text_of(outcome.end);
  std::string message = end->text;
  if (outcome.end == TraceEnd::critical_point)
    message += std::string(": ") + name_of(outcome.critical.back().type);
  if (outcome.end == TraceEnd::limit_points && analysis.control.type == ControlType::load)
    message = "under load control the path ends at its first limit point";
  message += " at load factor " + number(outcome.last.lambda / structure.scales.load) + " after " +
             std::to_string(result.diagnostics.steps) + " steps, " + std::to_string(outcome.last.negative) +
             " negative eigenvalues there";
  result.summary.termination = end->code;
  result.summary.message = message;
  if (end->failure) fail(result, end->code, message);
}

/// A bifurcation and a way through it that is still to be followed.
struct Pending {
  PathPoint at;
  int parent = 0;
  double sign = 1.0;
};

/// Follows the branches that cross the primary path, and those that cross them, as far as was asked.
class BranchFollower {
 public:
  BranchFollower(const Analysis& analysis, const Structure& structure, Continuation& continuation,
                 Recorder& recorder, CriticalLoads& loads, const Hooks& hooks)
      : analysis_(analysis),
        rules_(rules_of(analysis, structure)),
        continuation_(continuation),
        recorder_(recorder),
        loads_(loads),
        hooks_(hooks) {
    constexpr int kMostBranches = 20;
    limit_ = analysis.branches.limit.value_or(analysis.branches.follow == Follow::first ? 2 : kMostBranches);
  }

  void add(const TraceOutcome& outcome, int branch);
  /// @return a sentence on what was followed and what was left out
  [[nodiscard]] std::string run();

 private:
  [[nodiscard]] bool follow(const Pending& pending);

  const Analysis& analysis_;
  TraceRules rules_;
  Continuation& continuation_;
  Recorder& recorder_;
  CriticalLoads& loads_;
  const Hooks& hooks_;
  int limit_ = 0;
  int branches_ = 0;
  int lost_ = 0;
  int rejoined_ = 0;
  std::vector<Pending> pending_;
};

void BranchFollower::add(const TraceOutcome& outcome, int branch) {
  for (const CriticalEvent& event : outcome.critical) {
    if (event.type != CriticalType::bifurcation) continue;
    if (analysis_.branches.follow == Follow::first && !pending_.empty()) return;
    for (const double sign : {1.0, -1.0}) pending_.push_back({event.point, branch, sign});
    rules_.known.push_back(event.point);
  }
}

bool BranchFollower::follow(const Pending& pending) {
  const auto first = first_point_of_branch(continuation_, pending.at, pending.sign);
  if (!first) return false;
  const int id = ++branches_;
  const TraceSink sink = loads_.watch(recorder_.sink(hooks_, id, pending.parent));
  PathPoint origin = pending.at;
  origin.arc_length = 0.0;
  recorder_.add_point(origin);
  TraceRules rules = rules_;
  rules.first_step = 0.02;
  rules.zones = recorder_.zone_counter();
  const TraceOutcome outcome = trace(continuation_, first, rules, analysis_.step, sink, hooks_.stop);
  recorder_.end_branch(text_of(outcome.end).code);
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

}  // namespace

void run_path(const Model& model, const Analysis& analysis, const Structure& structure, const Hooks& hooks,
              Result& result) {
  StructuralProblem problem(structure);
  Continuation continuation(problem, options_of(analysis));
  Recorder recorder(model, analysis, structure, continuation, result);
  const auto start = start_of_path(model, structure, problem, continuation, 1.0, hooks, result);
  if (start) {
    CriticalLoads loads(model, analysis, structure, continuation, result);
    const TraceSink sink = loads.watch(recorder.sink(hooks));
    TraceRules rules = rules_of(analysis, structure);
    if (analysis.type == AnalysisType::path) rules.zones = recorder.zone_counter();
    const TraceOutcome outcome = trace(continuation, start, rules, analysis.step, sink, hooks.stop);
    recorder.end_branch(text_of(outcome.end).code);
    std::string branches;
    if (analysis.type == AnalysisType::path && analysis.branches.follow != Follow::primary) {
      BranchFollower follower(analysis, structure, continuation, recorder, loads, hooks);
      follower.add(outcome, 0);
      branches = follower.run();
    }
    add_statistics(continuation.statistics(), result);
    describe_end(analysis, outcome, structure, result);
    result.summary.message += branches;
    loads.estimate(hooks.stop);
  }
  recorder.finish();
}

}  // namespace snapthrough
