#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "solver/accuracy/static_states.h"
#include "solver/analysis/analyses.h"
#include "solver/analysis/capacity_rule.h"
#include "solver/analysis/frequency_probe.h"
#include "solver/analysis/observer.h"
#include "solver/analysis/softest_point.h"
#include "solver/analysis/vibration_rule.h"
#include "solver/events/critical_mode.h"
#include "solver/events/touching.h"
#include "solver/hooks.h"
#include "solver/newton/contact_state.h"
#include "solver/numeric/cancelled.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/problem/held_motions.h"
#include "solver/report/critical_point.h"
#include "solver/report/mode.h"
#include "solver/report/neutral_motion.h"
#include "solver/report/result_parts.h"
#include "solver/report/state.h"
#include "solver/report/support_state.h"
#include "solver/support/capacity.h"
#include "solver/trace/trace.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Limits of rows with small displacements.
struct LinearRows {
  static constexpr int corrections = 60;  ///< most corrections of a state whose contact is known
};

/// Stores the requested output of each load factor in request order.
class StaticRows {
 public:
  /// @param asked whether a row is requested, one entry per load factor
  /// @param visit may be empty
  StaticRows(const Analysis& analysis, const Structure& structure, const std::vector<char>& asked,
             const StateVisitor& visit)
      : model_(*structure.model),
        analysis_(analysis),
        structure_(structure),
        asked_(asked),
        visit_(visit),
        observer_(analysis, structure),
        state_loads_(analysis.output.at_load_factors.begin(), analysis.output.at_load_factors.end()),
        rows_(analysis.load_factors.size()) {
    if (analysis.output.frequencies > 0) probe_.emplace(structure, analysis);
  }

  /// Adds a row, unless its state is no equilibrium: then its text tells by how much.
  /// @param negative number of negative eigenvalues of the tangent at y
  /// @param context of the state
  void set(std::size_t index, const VectorXd& y, int negative, const PointContext& context);
  /// The states that set() refused; empty: none.
  [[nodiscard]] const std::string& refused() const { return refused_; }
  [[nodiscard]] bool has(std::size_t index) const { return rows_[index].has_value(); }
  /// Whether a requested row is still missing.
  [[nodiscard]] bool lacks(std::size_t index) const { return asked_[index] != 0 && !has(index); }
  /// Whether a requested load factor meets a condition.
  template <class Condition>
  [[nodiscard]] bool asks_for(const Condition& condition) const {
    for (std::size_t i = 0; i < asked_.size(); ++i)
      if (asked_[i] != 0 && condition(analysis_.load_factors[i])) return true;
    return false;
  }
  /// The equilibria of all rows so far.
  [[nodiscard]] std::vector<StaticState> equilibria() const {
    std::vector<StaticState> out;
    for (const auto& row : rows_)
      if (row) out.push_back(row->equilibrium);
    return out;
  }
  /// Fills the table, the states and the list of load factors that were not reached.
  void move_to(Result& result);

 private:
  struct Row {
    VectorXd monitors;
    std::vector<double> contact;
    StaticState equilibrium;
    std::optional<State> state;
    std::optional<Frequencies> frequencies;
  };
  [[nodiscard]] bool wants_state(std::size_t index) const;

  const ResolvedModel& model_;
  const Analysis& analysis_;
  const Structure& structure_;
  const std::vector<char>& asked_;
  const StateVisitor& visit_;
  std::optional<FrequencyProbe> probe_;
  Observer observer_;
  std::set<double> state_loads_;  ///< load factors with requested states
  std::vector<std::optional<Row>> rows_;
  std::string refused_;
};

bool StaticRows::wants_state(std::size_t index) const {
  const OutputOptions& output = analysis_.output;
  if (output.states == StateOutput::none) return false;
  if (output.states == StateOutput::every) return index % static_cast<std::size_t>(output.every) == 0;
  if (output.states != StateOutput::at_load_factors) return true;
  return state_loads_.contains(analysis_.load_factors[index]);
}

void StaticRows::set(std::size_t index, const VectorXd& y, int negative, const PointContext& context) {
  const double lambda = analysis_.load_factors[index] * structure_.scales.load;
  if (const double left = imbalance(structure_, y, lambda); !(left <= StateLimits::imbalance)) {
    refused_ += (refused_.empty() ? "" : "; ") + imbalance_text(analysis_.load_factors[index], left);
    return;
  }
  Row row{VectorXd(static_cast<Eigen::Index>(structure_.monitors.size())),
          contact_fractions(structure_, y),
          {index, y, lambda, negative, context},
          std::nullopt,
          std::nullopt};
  for (std::size_t i = 0; i < structure_.monitors.size(); ++i)
    row.monitors[static_cast<Eigen::Index>(i)] = structure_.monitors[i].row.dot(y);
  if (probe_)
    if (const auto found = probe_->at(y, lambda)) row.frequencies = probe_->in_units(*found);
  if (visit_) visit_(index, y, lambda);
  observer_.note(y, lambda, 0);
  observer_.note_stress(y, lambda, 0);
  if (wants_state(index)) {
    row.state = make_state(structure_, y, lambda, analysis_.output);
    row.state->load_factor = analysis_.load_factors[index];
  } else {
    observer_.add_to_extremes(y, lambda, 0);
  }
  rows_[index] = std::move(row);
}

void StaticRows::move_to(Result& result) {
  StaticTable& table = result.static_table.emplace();
  for (const MonitorRow& monitor : structure_.monitors) table.monitors.push_back({monitor.id, {}});
  for (const ResolvedFoundation& foundation : model_.foundations)
    table.contact_fraction.push_back({foundation.id, {}});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i]) {
      result.not_reached.push_back(analysis_.load_factors[i]);
      continue;
    }
    Row& row = *rows_[i];
    table.load_factor.push_back(analysis_.load_factors[i]);
    table.negative_eigenvalues.emplace_back(row.equilibrium.negative);
    for (std::size_t m = 0; m < table.monitors.size(); ++m)
      table.monitors[m].values.push_back(row.monitors[static_cast<Eigen::Index>(m)]);
    for (std::size_t f = 0; f < table.contact_fraction.size(); ++f)
      table.contact_fraction[f].values.push_back(row.contact[f]);
    if (probe_) table.frequencies.push_back(std::move(row.frequencies));
    table.state.emplace_back();
    if (!row.state) continue;
    table.state.back() = static_cast<int>(result.states.size());
    result.states.push_back(std::move(*row.state));
  }
  observer_.finish(result);
}

/// Corrects a state to rounding, where the search for contact stopped before. A state that is as exact as
/// stiff supports and pins let it be stays; imbalance() judges it.
void settle_to_rounding(StructuralProblem& problem, const PathMetric& metric, double lambda, Workspace& work,
                        int& factorizations, ContactState& state) {
  problem.residual(state.y, lambda, work.residual);
  state.relative_residual = problem.relative_residual(work.residual, state.y, lambda);
  const double rounding = std::max(Rounding::largest_residual, problem.residual_rounding(state.y, lambda));
  if (state.relative_residual <= rounding) return;
  const double size = std::max(metric.norm(state.y, 0.0), kRoundingResidual);
  VectorXd y = state.y;
  const CorrectorOutcome outcome =
      correct(problem, metric, {}, size, downhill({}, LinearRows::corrections), y, lambda, work);
  factorizations += outcome.factorisations;
  if (outcome.status == CorrectorStatus::converged)
    state = {std::move(y), outcome.tangent, outcome.relative_residual};
}

/// Equilibrium at one load factor with small displacements and unilateral contact.
/// @param holds set to the springs on motions without stiffness
std::optional<ContactState> solve_linear(const Structure& structure, StructuralProblem& problem,
                                         double factor, SharedHolds& holds, Result& result) {
  const PathMetric metric{&structure.metric, 0.0};
  Workspace work;
  const double lambda = factor * structure.scales.load;
  const SharedHolds soft = held_softly(problem);
  problem.set_holds(soft);
  auto state = find_contact_state(problem, metric, lambda, work, result.diagnostics.factorizations);
  if (soft) {
    holds = state ? softly_held(problem, soft, state->y, lambda).neutral : nullptr;
    problem.set_holds(holds);
    state = find_contact_state(problem, metric, lambda, work, result.diagnostics.factorizations);
  }
  if (state) settle_to_rounding(problem, metric, lambda, work, result.diagnostics.factorizations, *state);
  result.diagnostics.iterations = result.diagnostics.factorizations;
  if (state)
    result.diagnostics.max_relative_residual =
        std::max(result.diagnostics.max_relative_residual, state->relative_residual);
  return state;
}

/// @brief Makes the result's entry for a critical point of a static path, without mesh confirmation.
CriticalPoint unconfirmed_point(const Structure& structure, const CriticalEvent& event,
                                const VectorXd& motion) {
  const ResolvedModel& model = *structure.model;
  CriticalPoint point = critical_point(structure, event);
  if (point.multiplicity == 1)
    if (const auto member = member_that_buckles(structure, motion)) point.member = model.members[*member].id;
  return point;
}

/// Reports the critical point that ends a static path, as failure with its mode.
void fail_at(const Analysis& analysis, const Structure& structure, StructuralProblem& problem,
             const CriticalEvent& event, Result& result) {
  const ResolvedModel& model = *structure.model;
  const VectorXd motion = mode_of(problem, event);
  Mode mode = mode_displacements(structure, motion, analysis.output.points_per_member);
  scale_to_largest(mode);
  const CriticalPoint point = unconfirmed_point(structure, event, motion);
  result.critical_points.push_back(point);
  const bool is_turn = is_limit(event.type);
  const bool flutters = event.type == CriticalType::flutter;
  const bool diverges = event.cause == CriticalCause::massless;
  const std::string what = is_turn    ? "the path has a limit point"
                           : flutters ? "two natural frequencies meet and vibrations grow (flutter)"
                           : diverges ? "the freedoms without mass become unstable: the square of a natural "
                                        "frequency becomes infinite and then negative (divergence)"
                           : !point.member ? "the structure becomes unstable (bifurcation)"
                                           : "member \"" + *point.member + "\" buckles (bifurcation)";
  fail(result, is_turn ? "beyond_limit_point" : "beyond_critical_point",
       what + " at load factor " + number(point.load_factor) + ", before the asked ones; the motion " +
           (grows_from(event) ? "with that frequency " : "that loses its stiffness there ") +
           motion_text(mode, model));
}

/// Trace rules of a static path up to a load factor.
/// @param scale scaled load factor of the load factor 1
TraceRules static_rules(const ResolvedModel& model, const Analysis& analysis, const StaticRows& states,
                        double last, double scale) {
  TraceRules rules;
  rules.load = {{-last * scale, last * scale}};
  for (std::size_t i = 0; i < analysis.load_factors.size(); ++i)
    if (states.lacks(i)) rules.asked.loads.push_back({i, analysis.load_factors[i] * scale});
  rules.asked.once = true;
  rules.limit_points = 1;
  rules.first_loss_of_stability = analysis.unstable == Unstable::refuse;
  rules.locate = locate_options(model, analysis);
  return rules;
}

/// Sets the failure of a static path that ended before its last load factor.
void fail_at_end(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
                 StructuralProblem& problem, const TraceOutcome& outcome, Result& result) {
  const ResolvedModel& model = *structure.model;
  const std::string where = number(outcome.last.lambda / structure.scales.load);
  switch (outcome.end) {
    case TraceEnd::cancelled:
      fail(result, "cancelled", "cancelled at load factor " + where);
      return;
    case TraceEnd::critical_point:
    case TraceEnd::limit_points:
      fail_at(analysis, structure, problem, outcome.critical.back(), result);
      return;
    case TraceEnd::capacity:
      fail(result, "capacity",
           report_capacity(*capacity, model, capacity_load(*capacity, structure, outcome), result));
      return;
    case TraceEnd::unstable_at_start:
      fail(result, "beyond_critical_point", "the structure is unstable before the load grows");
      return;
    default:
      fail(result, "no_convergence", "the path could not be followed beyond load factor " + where);
  }
}

/// Keeps the states at the asked load factors that a path passes.
class StaticObserver final : public PathObserver {
 public:
  StaticObserver(const Analysis& analysis, const Structure& structure, SoftestPoint& softest,
                 StaticRows& states, Result& result)
      : analysis_(analysis),
        structure_(structure),
        softest_(softest),
        states_(states),
        result_(result),
        neutral_(structure, result.neutral_motion) {}

  void on_point(const PathPoint& point) override {
    softest_.set_unloaded(point);
    neutral_.note(point.context.holds, point.lambda / structure_.scales.load);
  }
  void on_unpinned(const PathPoint& point) override { on_point(point); }
  void on_critical(const CriticalEvent& event) override {
    if (event.negative_before == 0 && event.negative_after > 0) softest_.lose(event.point);
    if (!grows_from(event) || analysis_.unstable == Unstable::refuse) return;
    result_.warnings.push_back(
        {"unstable",
         std::string("vibrations grow (") + (event.type == CriticalType::flutter ? "flutter" : "divergence") +
             ") from load factor " + number(event.point.lambda / structure_.scales.load) + " on"});
  }
  void on_asked(std::size_t row, const PathPoint& state) override {
    states_.set(row, state.y, state.negative, state.context);
  }
  void on_step(const PathPoint& from, const PathPoint& to) override { softest_.add_step(from, to); }

 private:
  const Analysis& analysis_;
  const Structure& structure_;
  SoftestPoint& softest_;
  StaticRows& states_;
  Result& result_;
  NeutralMotionLog neutral_;
};

/// Follows the path through all load factors of one sign, stores their states; false when it ends earlier.
bool follow(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
            double direction, const Hooks& hooks, StaticRows& states, Result& result) {
  const ResolvedModel& model = *structure.model;
  double last = 0.0;
  for (std::size_t i = 0; i < analysis.load_factors.size(); ++i)
    if (states.lacks(i)) last = std::max(last, analysis.load_factors[i] * direction);
  StructuralProblem problem(structure);
  PathFollower follower(problem);
  PointSolver& solver = follower.solver();
  SoftestPoint softest(solver);
  const PathStart start =
      start_of_path(structure, problem, solver, direction, hooks, result,
                    [&softest](const PathPoint& unloaded) { softest.set_unloaded(unloaded); });
  if (const auto touching = with_least_piece(structure, problem, solver.norm(), start, result)) {
    result.failure.reset();
    return follow(analysis, *touching, capacity, direction, hooks, states, result);
  }
  if (!start) return false;
  if (start.grows_from && analysis.unstable == Unstable::refuse) {
    warn_of_growth_at_start(start, result);
    fail(result, "beyond_critical_point", result.warnings.back().detail);
    result.warnings.pop_back();
    return false;
  }
  warn_of_growth_at_start(start, result);
  for (std::size_t i = 0; i < analysis.load_factors.size(); ++i)
    if (analysis.load_factors[i] == 0.0 && start.point->lambda == 0.0 && states.lacks(i))
      states.set(i, start.point->y, start.point->negative, start.point->context);
  if (last == 0.0) return true;
  TraceRules rules = static_rules(model, analysis, states, last, structure.scales.load);
  rules.capacity = capacity_rule(capacity, structure, problem, analysis.load_factors);
  std::optional<FlutterSearch> flutter;
  rules.vibrations = vibration_rule(structure, solver, rules.locate.tolerance, flutter);
  StaticObserver observer(analysis, structure, softest, states, result);
  const TraceOutcome outcome = trace(follower, start.point, rules, analysis.step, {&observer}, hooks.stop);
  add_statistics(follower.statistics(), result);
  softest.report(structure, analysis, result);
  if (outcome.end == TraceEnd::load_factor) return true;
  fail_at_end(analysis, structure, capacity, problem, outcome, result);
  return false;
}

/// Finds each state of a structure that only tension stiffens alone, by least energy: no path from an
/// unloaded state leads there.
void find_tight_states(const Analysis& analysis, const Structure& structure, StaticRows& states,
                       Result& result) {
  StructuralProblem problem(structure);
  PathFollower follower(problem);
  PointSolver& solver = follower.solver();
  solver.norm().ignore_load();
  VectorXd y = VectorXd::Zero(structure.size);
  for (std::size_t i = 0; i < analysis.load_factors.size(); ++i) {
    if (!states.lacks(i)) continue;
    const std::string where = "at load factor " + number(analysis.load_factors[i]);
    if (!solver.find_tight_state(analysis.load_factors[i] * structure.scales.load, y)) {
      fail(result, "no_convergence",
           "no stable equilibrium was found " + where + "; the structure is loose without load");
    } else if (const VectorXd motion = solver.unresisted_motion(); motion.size() > 0) {
      fail(result, "loose_part",
           where +
               " a part of the structure hangs on slack members, so that its place is not determined (the "
               "motion is largest near node \"" +
               node_of_largest(structure, motion) + "\")");
    } else {
      states.set(i, y, 0, {});
    }
  }
  add_statistics(follower.statistics(), result);
}

/// Computes the states at all requested load factors.
void compute(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
             const Hooks& hooks, StaticRows& states, Result& result) {
  if (analysis.geometry == Geometry::linear) {
    StructuralProblem problem(structure);
    NeutralMotionLog neutral(structure, result.neutral_motion);
    for (std::size_t i = 0; i < analysis.load_factors.size(); ++i) {
      if (!states.lacks(i)) continue;
      SharedHolds holds;
      if (const auto state = solve_linear(structure, problem, analysis.load_factors[i], holds, result)) {
        states.set(i, state->y, state->tangent.negative, {holds, nullptr});
        neutral.note(holds, analysis.load_factors[i]);
      } else {
        fail(result, "no_convergence",
             "no equilibrium was found at load factor " + number(analysis.load_factors[i]) +
                 (has_joint_laws(*structure.model) ? "; joints with laws may carry no larger moment" : ""));
      }
    }
  } else if (structure.traits.loose) {
    find_tight_states(analysis, structure, states, result);
  } else {
    const bool falling = states.asks_for([](double factor) { return factor < 0.0; });
    const bool growing = states.asks_for([](double factor) { return factor >= 0.0; });
    if (growing) static_cast<void>(follow(analysis, structure, capacity, 1.0, hooks, states, result));
    if (falling) static_cast<void>(follow(analysis, structure, capacity, -1.0, hooks, states, result));
  }
}

/// The states of a static analysis on a mesh that meets its accuracy.
RefinedStates refined(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
                      const Hooks& hooks, const std::vector<StaticState>& states, Result& result) {
  Analysis bare = analysis;
  bare.output.states = StateOutput::none;
  bare.output.frequencies = 0;
  bare.output.extremes = false;
  const Hooks quiet{hooks.stop};
  const auto find = [&](const Structure& finer, const std::vector<StaticState>& wanted) {
    std::vector<char> asked(analysis.load_factors.size(), 0);
    for (const StaticState& state : wanted) asked[state.row] = 1;
    StaticRows rows(bare, finer, asked, {});
    Result found;
    found.diagnostics.factorizations = 0;
    compute(bare, finer, capacity, quiet, rows, found);
    result.diagnostics.factorizations += found.diagnostics.factorizations;
    return rows.equilibria();
  };
  return refine_states(analysis.discretization, structure, states, find);
}

/// Reports the stability of the rows, in the message or in a warning.
void report_stability(const Analysis& analysis, Result& result) {
  const StaticTable& table = *result.static_table;
  std::size_t unstable = 0;
  std::optional<double> first;
  for (std::size_t i = 0; i < table.load_factor.size(); ++i) {
    if (table.negative_eigenvalues[i].value_or(0) == 0) continue;
    ++unstable;
    if (!first || std::abs(table.load_factor[i]) < std::abs(*first)) first = table.load_factor[i];
  }
  if (analysis.geometry == Geometry::linear) {
    result.summary.message += "; displacements are taken as small, and nothing is said about stability";
  } else if (unstable == 0) {
    const bool is_doubted =
        std::any_of(result.warnings.begin(), result.warnings.end(), [](const Warning& warning) {
          return warning.code == "unstable" || warning.code == "flutter_not_tested";
        });
    if (!result.failure)
      result.summary.message +=
          is_doubted ? ", every one stable by the static test alone" : ", every one stable";
  } else {
    const std::string text = std::to_string(unstable) + " of " + std::to_string(table.load_factor.size()) +
                             " load factors have unstable equilibria, the first of them " + number(*first);
    result.warnings.push_back({"unstable", text});
    if (analysis.unstable == Unstable::refuse && !result.failure)
      fail(result, "beyond_critical_point",
           text + "; the point where the path loses stability was not found");
  }
}

}  // namespace

void run_static(const Analysis& analysis, const Structure& structure, const HeldRows& held,
                const Hooks& hooks, Result& result, const StateVisitor& visit) {
  StaticRows states(analysis, structure, held.factors, visit);
  result.summary.termination = "load_factors";
  result.summary.message = "equilibrium at " + std::to_string(analysis.load_factors.size()) + " load factors";
  if (!unless_cancelled([&] { compute(analysis, structure, held.capacity, hooks, states, result); }))
    fail(result, "cancelled", "cancelled before all load factors were reached");
  if (!result.failure && !states.refused().empty()) fail(result, "no_convergence", states.refused());
  for (std::size_t i = 0; i < analysis.load_factors.size() && !result.failure; ++i)
    if (states.lacks(i))
      fail(result, "no_convergence", "load factor " + number(analysis.load_factors[i]) + " was not reached");
  // vibrations are compared on meshes of their own
  const std::vector<StaticState> found = states.equilibria();
  std::optional<RefinedStates> finer;
  std::optional<StaticRows> of_finer;
  if (!visit && !found.empty() && !analysis.discretization.fixed_mesh)
    static_cast<void>(
        unless_cancelled([&] { finer = refined(analysis, structure, held.capacity, hooks, found, result); }));
  if (finer && finer->structure.get() != &structure) {
    of_finer.emplace(analysis, *finer->structure, held.factors, visit);
    for (const StaticState& state : finer->states)
      of_finer->set(state.row, state.y, state.negative, state.context);
    if (!result.failure && !of_finer->refused().empty()) fail(result, "no_convergence", of_finer->refused());
  }
  if (finer) report_accuracy(*finer, analysis.discretization, result);
  (of_finer ? *of_finer : states).move_to(result);
  warn_of_untested_flutter(structure, result);
  report_stability(analysis, result);
  if (structure.traits.loose)
    result.summary.message +=
        "; the structure is loose without load, and each state was found by least energy";
}

}  // namespace snapthrough
