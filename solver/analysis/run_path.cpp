#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/accuracy/critical_loads.h"
#include "solver/accuracy/layers.h"
#include "solver/accuracy/polish.h"
#include "solver/analysis/analyses.h"
#include "solver/analysis/branch_follower.h"
#include "solver/analysis/capacity_rule.h"
#include "solver/analysis/monitor_watch.h"
#include "solver/analysis/path_messages.h"
#include "solver/analysis/path_rules.h"
#include "solver/analysis/recorder.h"
#include "solver/analysis/vibration_rule.h"
#include "solver/discrete/build_structure.h"
#include "solver/events/touching.h"
#include "solver/hooks.h"
#include "solver/numeric/cancelled.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/report/result_parts.h"
#include "solver/report/skipped.h"
#include "solver/sensitivity/koiter_coefficients.h"
#include "solver/sensitivity/load_sensitivities.h"
#include "solver/trace/trace.h"

namespace snapthrough {
namespace {

/// Limits of the meshes on which a path is followed. Chosen.
struct PathMeshes {
  static constexpr int most = 4;       ///< successively finer meshes
  static constexpr double work = 1e7;  ///< elements times factorisations of a path: about ten seconds
};

/// Step control options. On a mesh chosen for an accuracy, points without reported states are corrected only
/// to a small part of that accuracy.
PathOptions options_of(const Analysis& analysis) {
  PathOptions options;
  if (points_are_not_polished(analysis))
    options.corrector.tangent_tolerance = std::min(1e-4, 10.0 * analysis.discretization.accuracy);
  return options;
}

/// Function that adds requested sensitivities and Koiter coefficients to a critical point, and shows it to
/// the visitor; may be empty.
Complete completer(const Analysis& analysis, const Hooks& hooks, const CriticalVisitor& visit,
                   Result& result) {
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
  recorder.end_branch(code_of(outcome.end));
  const std::size_t primary = result.critical_points.size();
  std::string branches;
  if (analysis.traits().reports_path && analysis.branches.follow != Follow::primary) {
    BranchFollower followed(analysis, structure, follower, recorder, loads, watch, hooks);
    followed.add(outcome, 0);
    static_cast<void>(unless_cancelled([&] { branches = followed.run(); }));
  }
  add_statistics(follower.statistics(), result);
  bool confirmed = true;
  std::string meshes;
  if (!analysis.discretization.fixed_mesh && !outcome.on_critical && !is_failure(outcome.end)) {
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
  return analysis.traits().reports_path ? analysis.step.direction : 1.0;
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
    if (paths == PathMeshes::most) break;
    auto next = much_finer(*mesh, decays);
    if (!next) break;
    if (static_cast<double>(factorizations) * static_cast<double>(next->elements.size()) > PathMeshes::work)
      break;
    earlier = result.critical_points;
    finer = on_mesh(structure, *std::move(next));
    mesh = &*finer;
  }
  fail_unconfirmed(analysis, result);
}

}  // namespace snapthrough
