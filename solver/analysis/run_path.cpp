#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/analysis/recorder.h"
#include "solver/path/trace.h"

namespace snapthrough {
namespace {

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
    {TraceEnd::steps, "steps", "the path was still going on", false},
    {TraceEnd::displacement_bound, "displacement_bound", "displacements grew beyond any bound of interest",
     false},
    {TraceEnd::cancelled, "cancelled", "cancelled", true},
    {TraceEnd::step_underflow, "step_underflow", "no smaller step converged; the path stands", true},
    {TraceEnd::no_start, "no_start", "no equilibrium was found for the first small load", true}};

void describe_end(const Analysis& analysis, const TraceOutcome& outcome, const Structure& structure,
                  Result& result) {
  const auto* end = std::find_if(std::begin(kEnds), std::end(kEnds),
                                 [&outcome](const EndText& e) { return e.end == outcome.end; });
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

}  // namespace

void run_path(const Model& model, const Analysis& analysis, const Structure& structure, const Hooks& hooks,
              Result& result) {
  StructuralProblem problem(structure);
  Continuation continuation(problem, {});
  Recorder recorder(model, analysis, structure, continuation, result);
  const auto start = start_of_path(structure, problem, continuation, 1.0, hooks, result);
  if (start) {
    const TraceSink sink = recorder.sink(hooks);
    const TraceOutcome outcome =
        trace(continuation, start, rules_of(analysis, structure), analysis.step, sink, hooks.stop);
    add_statistics(continuation.statistics(), result);
    describe_end(analysis, outcome, structure, result);
  }
}

}  // namespace snapthrough
