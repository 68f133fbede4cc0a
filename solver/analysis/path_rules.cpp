#include "solver/analysis/path_rules.h"

#include <algorithm>
#include <string>

#include "solver/analysis/analyses.h"
#include "solver/report/strain.h"

namespace snapthrough {
namespace {

/// Limits of a path where the request has none. Chosen; docs/requests.md and docs/theory.md tell them.
struct PathLimits {
  /// Steps of a search for the loss of stability: only paths that do not progress or leave the range of the
  /// theory reach them.
  static constexpr int search_steps = 20000;
  /// Negative eigenvalues that a path may gain: a straight column under axial load meets a hundred
  /// bifurcations before the bound on its load.
  static constexpr int losses = 10;
};

const SparseRow* row_of(const Structure& structure, const std::string& monitor) {
  const auto found = std::find_if(structure.monitors.begin(), structure.monitors.end(),
                                  [&monitor](const MonitorRow& m) { return m.id == monitor; });
  return &found->row;
}

}  // namespace

TraceRules rules_of(const Analysis& analysis, const Structure& structure) {
  const ResolvedModel& model = *structure.model;
  TraceRules rules;
  rules.locate = locate_options(model, analysis);
  if (analysis.traits().ends_at_loss()) {
    rules.first_loss_of_stability = true;
    rules.steps = PathLimits::search_steps;
    rules.beyond_theory = [gauge = StrainGauge(structure)](const PathPoint& at) {
      return gauge.is_beyond_theory(at.y);
    };
    return rules;
  }
  const StopRules& stop = analysis.stop;
  rules.limit_points = stop.limit_points;
  if (stop.steps) rules.steps = *stop.steps;
  if (stop.load_factor)
    rules.load = {
        {(*stop.load_factor)[0] * structure.scales.load, (*stop.load_factor)[1] * structure.scales.load}};
  const auto value_of = [](const SparseRow* row) {
    return [row](const PathPoint& point) { return row->dot(point.y); };
  };
  if (stop.monitor) rules.monitor = {value_of(row_of(structure, stop.monitor->id)), stop.monitor->range};
  if (analysis.control.type == ControlType::load) rules.limit_points = 1;
  if (analysis.control.type == ControlType::displacement) {
    const SparseRow* row = row_of(structure, analysis.control.monitor);
    // a monitor is linear in the unknowns: its rate is its value on the tangent
    rules.controlled = {value_of(row), [row](const PathPoint& point) { return row->dot(point.tangent); }};
  }
  return rules;
}

const SparseRow* row_of_stop(const Structure& structure, const Analysis& analysis) {
  if (!analysis.traits().reports_path || !analysis.stop.monitor) return nullptr;
  return row_of(structure, analysis.stop.monitor->id);
}

void bound_negative(const Analysis& analysis, int at_start, const MonitorWatch& watch, TraceRules& rules) {
  const StopRules& stop = analysis.stop;
  if (!analysis.traits().reports_path) return;
  rules.most_negative = stop.negative_eigenvalues;
  if (rules.most_negative || stop.load_factor || stop.steps) return;
  rules.most_negative = at_start + PathLimits::losses + stop.limit_points.value_or(0);
  rules.most_negative_waits = [&watch](const PathPoint& at) { return watch.has_moved(at.y); };
}

}  // namespace snapthrough
