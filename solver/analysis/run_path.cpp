#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/accuracy/critical_loads.h"
#include "solver/accuracy/layers.h"
#include "solver/accuracy/polish.h"
#include "solver/analysis/analyses.h"
#include "solver/analysis/capacity_rule.h"
#include "solver/analysis/monitor_watch.h"
#include "solver/analysis/recorder.h"
#include "solver/analysis/vibration_rule.h"
#include "solver/discrete/build_structure.h"
#include "solver/events/branch.h"
#include "solver/events/touching.h"
#include "solver/hooks.h"
#include "solver/numeric/cancelled.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/report/result_parts.h"
#include "solver/report/skipped.h"
#include "solver/report/strain.h"
#include "solver/sensitivity/koiter_coefficients.h"
#include "solver/sensitivity/load_sensitivities.h"
#include "solver/trace/trace.h"

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
  static constexpr int branches = 20;  ///< branches that are followed
  static constexpr int meshes = 4;     ///< successively finer meshes on which the path is followed
  static constexpr double work = 1e7;  ///< elements times factorisations of a path: about ten seconds
};

const SparseRow* row_of(const Structure& structure, const std::string& monitor) {
  const auto found = std::find_if(structure.monitors.begin(), structure.monitors.end(),
                                  [&monitor](const MonitorRow& m) { return m.id == monitor; });
  return &found->row;
}

TraceRules rules_of(const Analysis& analysis, const Structure& structure) {
  const ResolvedModel& model = *structure.model;
  TraceRules rules;
  rules.locate = locate_options(model, analysis);
  if (analysis.type == AnalysisType::critical) {
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

/// Row of the monitor of the stop rule; null: the request has no such rule.
const SparseRow* row_of_stop(const Structure& structure, const Analysis& analysis) {
  if (analysis.type != AnalysisType::path || !analysis.stop.monitor) return nullptr;
  return row_of(structure, analysis.stop.monitor->id);
}

/// @brief Limits the negative eigenvalues of a path: to the request's bound; else, without a bound on load
/// factor or steps, to PathLimits::losses more than at the start plus one per requested limit point. The
/// latter limit is suspended while the monitor of a stop rule moves.
/// @param watch must outlive `rules`
void bound_negative(const Analysis& analysis, int at_start, const MonitorWatch& watch, TraceRules& rules) {
  const StopRules& stop = analysis.stop;
  if (analysis.type != AnalysisType::path) return;
  rules.most_negative = stop.negative_eigenvalues;
  if (rules.most_negative || stop.load_factor || stop.steps) return;
  rules.most_negative = at_start + PathLimits::losses + stop.limit_points.value_or(0);
  rules.most_negative_waits = [&watch](const PathPoint& at) { return watch.has_moved(at.y); };
}

/// Step control options. On a mesh chosen for an accuracy, points without reported states are corrected only
/// to a small part of that accuracy.
PathOptions options_of(const Analysis& analysis) {
  PathOptions options;
  if (points_are_not_polished(analysis))
    options.corrector.tangent_tolerance = std::min(1e-4, 10.0 * analysis.discretization.accuracy);
  return options;
}

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

/// @param at load factor at the path's end
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

/// Start of the message of a `path` analysis: the first loss of stability; empty: none.
std::string loss_on_the_way(const Analysis& analysis, const Result& result) {
  const CriticalPoint* loss = first_loss(analysis, result.critical_points);
  if (analysis.type != AnalysisType::path || loss == nullptr) return "";
  return std::string("first loss of stability: ") + name_of(*loss) + " at load factor " +
         number(loss->load_factor) + "; ";
}

/// Warns of a stop rule that is ineffective because its monitor does not move.
void warn_of_still_monitor(const Analysis& analysis, const MonitorWatch& watch, Result& result) {
  if (!watch.is_still()) return;
  result.warnings.push_back(
      {"monitor_still", "monitor \"" + analysis.stop.monitor->id +
                            "\" does not move on any path that was followed: its stop rule could not act"});
}

/// Sets the failure of a path that finer meshes do not confirm.
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

/// Bifurcation with one direction along its branch that remains to be followed.
struct Pending {
  CriticalEvent at;
  int parent = 0;
  double sign = 1.0;
};

/// Follows branches of the primary path, and branches of those, within the request's limits.
class BranchFollower {
 public:
  BranchFollower(const Analysis& analysis, const Structure& structure, PathFollower& follower,
                 Recorder& recorder, CriticalLoads& loads, MonitorWatch& watch, const Hooks& hooks)
      : analysis_(analysis),
        rules_(rules_of(analysis, structure)),
        follower_(follower),
        recorder_(recorder),
        loads_(loads),
        watch_(watch),
        hooks_(hooks) {
    limit_ = analysis.branches.limit.value_or(
        analysis.branches.follow == Follow::first ? 2 : PathLimits::branches);
  }

  void add(const TraceOutcome& outcome, int branch);
  /// @return sentence on the branches that were followed and omitted
  [[nodiscard]] std::string run();

 private:
  [[nodiscard]] bool follow(const Pending& pending);

  const Analysis& analysis_;
  TraceRules rules_;
  PathFollower& follower_;
  Recorder& recorder_;
  CriticalLoads& loads_;
  MonitorWatch& watch_;
  const Hooks& hooks_;
  int limit_ = 0;
  int branches_ = 0;
  int lost_ = 0;
  int rejoined_ = 0;
  std::vector<Pending> pending_;
};

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
  rules.first_step = 0.02;
  bound_negative(analysis_, first->negative, watch_, rules);
  rules.finer_imperfection = [this](const CriticalEvent& event) { return loads_.finer_imperfection(event); };
  recorder_.ask(rules);
  const TraceOutcome outcome =
      trace(follower_, first, rules, analysis_.step, {&watch_, &recorder_, &loads_}, hooks_.stop);
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

namespace {

/// Function that adds requested sensitivities and Koiter coefficients to a critical point, and shows it to
/// the visitor; may be empty.
Complete completer(const Analysis& analysis, const Hooks& hooks,
                   const CriticalVisitor& visit, Result& result) {
  if (analysis.sensitivities.empty() && !analysis.koiter && !visit) return {};
  return [&](const Structure& structure, const PathNorm& norm, const CriticalEvent& event,
             CriticalPoint& point) {
    const LocatedPoint at{event, norm.metric().load_weight,
                          PolishLimits::reach * norm.search_scale(event.point), norm.least_load()};
    int& factorisations = result.diagnostics.factorizations;
    const auto offsets = [&](const ResolvedModel& changed) {
      return mode_offsets(changed, analysis, hooks.stop);
    };
    if (!analysis.sensitivities.empty())
      point.sensitivities =
          load_sensitivities(analysis.sensitivities, structure, at, offsets, factorisations);
    if (analysis.koiter)
      point.koiter = koiter_coefficients(structure, at, analysis.output.points_per_member, factorisations);
    if (visit) visit(structure, at, point, factorisations);
  };
}

/// Rules of a primary path.
/// @param problem, watch, loads, recorder kept by reference; must outlive the rules
TraceRules primary_rules(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
                         StructuralProblem& problem, CriticalLoads& loads, Recorder& recorder) {
  TraceRules rules = rules_of(analysis, structure);
  rules.capacity = capacity_rule(capacity, structure, problem, analysis.output.at_load_factors);
  rules.finer_imperfection = [&loads](const CriticalEvent& event) { return loads.finer_imperfection(event); };
  recorder.ask(rules);
  return rules;
}

/// Reports the capacity of supports that ended a path.
/// @param count critical points of the primary path in the result
/// @return whether everything that the path met is confirmed; the limit needs no finer mesh
bool confirm_capacity(const Analysis& analysis, const Structure& structure, const CapacityEnds& capacity,
                      const TraceOutcome& outcome, std::size_t count, bool confirmed, Result& result) {
  report_capacity_point(analysis, capacity, structure, outcome, count, result);
  if (!outcome.on_critical) return confirmed;
  return std::ranges::all_of(result.critical_points, &CriticalPoint::confirmed);
}

/// Sets the rule that follows the natural motions, and what is known of them at the start.
/// @param flutter has to live as long as the rules
void add_vibration_rule(const Structure& structure, PointSolver& solver, const PathStart& start,
                        std::optional<FlutterSearch>& flutter, TraceRules& rules) {
  rules.vibrations = vibration_rule(structure, solver, rules.locate.tolerance, flutter);
  rules.grows_at_start = start.grows_from.has_value();
}

void warn_of_vibrations(const Structure& structure, const PathStart& start, Result& result) {
  warn_of_untested_flutter(structure, result);
  warn_of_growth_at_start(start, result);
}

/// Follows the path on one mesh.
/// @param earlier critical points of the path on a coarser mesh
/// @param decays bending decay lengths at the path's end, for the next mesh
/// @return whether finer meshes confirm the result, or nothing needs confirmation
bool follow_on(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
               const std::vector<CriticalPoint>& earlier, const Hooks& hooks, const CriticalVisitor& visit,
               Result& result, std::vector<double>& decays) {
  StructuralProblem problem(structure);
  PathFollower follower(problem, options_of(analysis));
  PointSolver& solver = follower.solver();
  SoftestPoint softest(solver);
  const auto start =
      analysis.start
          ? start_at_state(structure, solver, analysis, result)
          : start_of_path(structure, problem, solver, path_direction(analysis), hooks, result,
                          [&softest](const PathPoint& unloaded) { softest.set_unloaded(unloaded); });
  if (const auto touching = with_least_piece(structure, problem, solver.norm(), start, result)) {
    result.failure.reset();
    return follow_on(analysis, *touching, capacity, earlier, hooks, visit, result, decays);
  }
  if (!start) return true;
  Recorder recorder(analysis, structure, solver, softest, hooks, result);
  CriticalLoads loads(analysis, structure, follower, earlier, result);
  MonitorWatch watch(structure, row_of_stop(structure, analysis), start.point->y);
  recorder.begin_branch();
  TraceRules rules = primary_rules(analysis, structure, capacity, problem, loads, recorder);
  bound_negative(analysis, start.point->negative, watch, rules);
  std::optional<FlutterSearch> flutter;
  add_vibration_rule(structure, solver, start, flutter, rules);
  for (const CriticalPoint& point : earlier)
    if (point.branch == 0) rules.expected.push_back(point.load_factor * structure.scales.load);
  const TraceOutcome outcome =
      trace(follower, start.point, rules, analysis.step, {&watch, &recorder, &loads}, hooks.stop);
  recorder.end_branch(text_of(outcome.end).code);
  const std::size_t primary = result.critical_points.size();
  std::string branches;
  if (analysis.type == AnalysisType::path && analysis.branches.follow != Follow::primary) {
    BranchFollower followed(analysis, structure, follower, recorder, loads, watch, hooks);
    followed.add(outcome, 0);
    static_cast<void>(unless_cancelled([&] { branches = followed.run(); }));
  }
  add_statistics(follower.statistics(), result);
  bool confirmed = true;
  std::string meshes;
  if (!analysis.discretization.fixed_mesh && !outcome.on_critical && !text_of(outcome.end).failure) {
    confirmed = unless_cancelled([&] { confirmed = loads.confirm_end(outcome.last); }) && confirmed;
    if (confirmed && result.critical_points.empty())
      meshes = "; no critical point was met, and a finer mesh agrees at the path's end";
  }
  const Complete complete = completer(analysis, hooks, visit, result);
  confirmed = loads.confirm(hooks.stop, meshes, complete) && confirmed;
  const double at = outcome.on_critical ? result.critical_points[primary - 1].load_factor
                                        : outcome.last.lambda / structure.scales.load;
  describe_end(analysis, outcome, at, result);
  if (outcome.end == TraceEnd::capacity)
    confirmed = confirm_capacity(analysis, structure, *capacity, outcome, primary, confirmed, result);
  result.summary.message = loss_on_the_way(analysis, result) + result.summary.message + branches + meshes;
  warn_of_still_monitor(analysis, watch, result);
  warn_of_vibrations(structure, start, result);
  recorder.finish(confirmed || result.failure);
  softest.report(structure, analysis, result);
  decays = bending_decays(structure, outcome.last.y);
  return confirmed || result.failure;
}

/// Mesh after an unconfirmed path: every element divided into four, or the mesh that resolves every
/// foundation if that has fewer elements; refined at boundary layers of the path's end state. Empty when no
/// still finer mesh could confirm it.
std::optional<Mesh> much_finer(const Structure& structure, const std::vector<double>& decays) {
  const ResolvedModel& model = *structure.model;
  const auto halved = finer_mesh(structure.mesh);
  const auto quartered = halved ? finer_mesh(*halved) : std::nullopt;
  if (!quartered) return std::nullopt;
  const Mesh resolved = make_mesh(model, as_stiff_as_given({}), structure.axes, MeshUse::first);
  const bool is_enough = resolved.elements.size() > structure.mesh.elements.size() &&
                         resolved.elements.size() < quartered->elements.size();
  Mesh next = layered_mesh(is_enough ? resolved : *quartered, model, structure.axes, decays);
  // a path that no finer mesh can confirm is not followed
  return finer_mesh(next) ? std::optional(std::move(next)) : std::nullopt;
}

/// Whether an imperfection moves the axis of a member.
bool has_offsets(const ResolvedModel& model) {
  const auto moves = [](const auto& one) {
    if constexpr (requires { one.offsets; })
      return std::ranges::any_of(one.offsets, [](const auto& pair) { return pair[1] != 0.0; });
    else
      return one.amplitude != 0.0;
  };
  return std::ranges::any_of(model.imperfections,
                             [&](const ResolvedImperfection& one) { return std::visit(moves, one); });
}

}  // namespace

LocateOptions locate_options(const ResolvedModel& model, const Analysis& analysis) {
  LocateOptions options;
  // an imperfection of the request breaks bifurcations, however small
  const bool imperfect = has_offsets(model);
  if (imperfect) options.perfect = Rounding::imperfection;
  if (analysis.discretization.fixed_mesh) return options;
  options.tolerance = std::min(1e-7, 1e-3 * analysis.discretization.accuracy);
  // a broken bifurcation has its limit point, if any, lower by about 10 e^(2/3)
  if (!imperfect)
    options.perfect = std::max(options.perfect, imperfection_of(analysis.discretization.accuracy));
  return options;
}

double path_direction(const Analysis& analysis) {
  return analysis.type == AnalysisType::path ? analysis.step.direction : 1.0;
}

bool is_loss_of_stability(const Analysis& analysis, const CriticalPoint& point) {
  return point.branch == 0 && point.negative_before == 0 && !point.after_growth &&
         (point.negative_after > 0 || grows_from(point)) &&
         (analysis.start || point.load_factor * path_direction(analysis) > 0.0);
}

void run_path(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
              const Hooks& hooks, Result& result, const CriticalVisitor& visit) {
  const Structure* mesh = &structure;
  std::optional<Structure> finer;
  std::vector<CriticalPoint> earlier;
  for (int paths = 1;; ++paths) {
    Result reached;
    reached.diagnostics = result.diagnostics;
    std::vector<double> decays;
    const bool confirmed = follow_on(analysis, *mesh, capacity, earlier, hooks, visit, reached, decays);
    const int factorizations = reached.diagnostics.factorizations - result.diagnostics.factorizations;
    result = std::move(reached);
    report_path_mesh(*mesh, paths, result);
    result.diagnostics.skipped = mesh->skipped;
    if (confirmed || analysis.discretization.fixed_mesh || hooks.stop.stop_requested()) return;
    if (paths == PathLimits::meshes) break;
    auto next = much_finer(*mesh, decays);
    if (!next) break;
    if (static_cast<double>(factorizations) * static_cast<double>(next->elements.size()) > PathLimits::work)
      break;
    earlier = result.critical_points;
    finer = on_mesh(structure, *std::move(next));
    mesh = &*finer;
  }
  fail_unconfirmed(analysis, result);
}

}  // namespace snapthrough
