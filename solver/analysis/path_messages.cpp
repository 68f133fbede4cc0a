#include "solver/analysis/path_messages.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "solver/analysis/analyses.h"
#include "solver/numeric/number_text.h"
#include "solver/report/result_parts.h"

namespace snapthrough {
namespace {

/// Name of the kind of a critical point or event.
template <class Critical>
const char* name_of(const Critical& point) {
  if (point.cause == CriticalCause::massless) return "divergence of freedoms without mass";
  switch (point.type) {
    case CriticalType::bifurcation:
      return "bifurcation";
    case CriticalType::limit_max:
      return "limit point (maximum)";
    case CriticalType::limit_min:
      return "limit point (minimum)";
    case CriticalType::broken_bifurcation:
      return "broken bifurcation";
    case CriticalType::flutter:
      return "flutter";
    case CriticalType::capacity:
      return "capacity of supports";
  }
  return "";
}

/// Termination code of a trace with its message.
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
    {TraceEnd::negative_eigenvalues, "negative_eigenvalues",
     "the path has more negative eigenvalues than are followed (stop.negative_eigenvalues)", false},
    {TraceEnd::displacement_bound, "displacement_bound",
     "displacements or strains grew beyond any bound of interest", false},
    {TraceEnd::load_bound, "load_bound", "the load grew beyond any bound of interest", false},
    {TraceEnd::capacity, "capacity", "the supports are at their capacity", false},
    {TraceEnd::cancelled, "cancelled", "cancelled", true},
    {TraceEnd::step_underflow, "step_underflow", "no smaller step converged; the path stands", true},
    {TraceEnd::no_start, "no_start", "no equilibrium was found for the first small load", true}};

const EndText& text_of(TraceEnd end) {
  return *std::find_if(std::begin(kEnds), std::end(kEnds), [end](const EndText& e) { return e.end == end; });
}

/// Message on the negative eigenvalues at the path's end. At a critical point the counts on both sides are
/// given, because rounding decides the signs of vanishing eigenvalues at the point itself.
std::string count_at_end(const TraceOutcome& outcome) {
  if (!outcome.on_critical)
    return ", " + std::to_string(outcome.last.negative) + " negative eigenvalues there";
  const CriticalEvent& event = outcome.critical.back();
  return "; negative eigenvalues: " + std::to_string(event.negative_before) + " before, " +
         std::to_string(event.negative_after) + " after";
}

/// Message on the critical points that meshes do not agree on; at most MessageLimits::items points.
std::string disagreements(const Result& result) {
  std::string text;
  int left = 0;
  for (const CriticalPoint& point : result.critical_points) {
    if (point.confirmed) continue;
    if (++left > MessageLimits::items) continue;
    text += "; " + std::string(name_of(point)) + " at " + number(point.load_factor) + ":";
    for (const MeshAnswer& mesh : point.meshes)
      text += " " + std::to_string(mesh.elements) + " elements of order " + std::to_string(mesh.order) + " " +
              (mesh.load_factor ? number(*mesh.load_factor) : std::string("nothing")) + ",";
    text.pop_back();
  }
  if (left > MessageLimits::items) text += "; and " + std::to_string(left - MessageLimits::items) + " more";
  return text;
}

/// First critical point of the primary path at which stability is lost; null: none.
const CriticalPoint* first_loss(const Analysis& analysis, const std::vector<CriticalPoint>& points) {
  const auto found = std::find_if(points.begin(), points.end(), [&analysis](const CriticalPoint& point) {
    return is_loss_of_stability(analysis, point);
  });
  return found == points.end() ? nullptr : &*found;
}

}  // namespace

const char* code_of(TraceEnd end) { return text_of(end).code; }

bool is_failure(TraceEnd end) { return text_of(end).failure; }

void describe_end(const Analysis& analysis, const TraceOutcome& outcome, double at, Result& result) {
  const EndText* end = &text_of(outcome.end);
  std::string message = end->text;
  if (outcome.end == TraceEnd::critical_point)
    message += std::string(": ") + name_of(outcome.critical.back());
  if (outcome.end == TraceEnd::limit_points && analysis.control.type == ControlType::load)
    message = "under load control the path ends at its first limit point";
  message += " at load factor " + number(at) + " after " + std::to_string(result.diagnostics.steps) +
             " steps" + count_at_end(outcome);
  result.summary.termination = end->code;
  result.summary.message = message;
  if (end->failure) fail(result, end->code, message);
}

std::string loss_on_the_way(const Analysis& analysis, const Result& result) {
  const CriticalPoint* loss = first_loss(analysis, result.critical_points);
  if (!analysis.traits().reports_path || loss == nullptr) return "";
  return std::string("first loss of stability: ") + name_of(*loss) + " at load factor " +
         number(loss->load_factor) + "; ";
}

void warn_of_still_monitor(const Analysis& analysis, const MonitorWatch& watch, Result& result) {
  if (!watch.is_still()) return;
  result.warnings.push_back(
      {"monitor_still", "monitor \"" + analysis.stop.monitor->id +
                            "\" does not move on any path that was followed: its stop rule could not act"});
}

void fail_unconfirmed(const Analysis& analysis, Result& result) {
  const bool some = std::any_of(result.critical_points.begin(), result.critical_points.end(),
                                [](const CriticalPoint& point) { return !point.confirmed; });
  const std::string reached = result.summary.message;
  fail(result, "not_confirmed",
       (some ? "finer meshes do not confirm all critical points within the accuracy asked for" +
                   disagreements(result)
             : std::string(
                   "a finer mesh has no equilibrium with as many negative eigenvalues near the path's end")) +
           " (" + reached + ")");
  const CriticalPoint* loss = first_loss(analysis, result.critical_points);
  if (result.summary.critical_load_factor && loss != nullptr && !loss->confirmed)
    withdraw_critical_load(result);
}

}  // namespace snapthrough
