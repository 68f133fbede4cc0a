#include "solver/analysis/recorder.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/analysis/path_states.h"
#include "solver/discrete/structure.h"
#include "solver/hooks.h"
#include "solver/numeric/number_text.h"
#include "solver/report/critical_point.h"
#include "solver/report/mode.h"
#include "solver/report/result_parts.h"
#include "solver/report/state.h"

namespace snapthrough {

double Recorder::user_load(const PathPoint& point) const { return point.lambda / structure_.scales.load; }

std::optional<int> Recorder::add_state(const PathPoint& point, double most) {
  if (const double left = imbalance(structure_, point.y, point.lambda); !(left <= most)) {
    refused_ += (refused_.empty() ? "" : "; ") + imbalance_text(user_load(point), left);
    return std::nullopt;
  }
  State state = make_state(structure_, point.y, point.lambda, analysis_.output);
  state.branch = branch_;
  result_.states.push_back(std::move(state));
  return static_cast<int>(result_.states.size()) - 1;
}

void Recorder::begin_branch(int branch_number, std::optional<int> parent) {
  branch_ = branch_number;
  branch_points_ = 0;
  neutral_.start(branch_);
  observer_.begin_path();
  if (!analysis_.traits().reports_path) return;
  Branch branch;
  branch.id = branch_;
  branch.parent = parent;
  branch.rates.emplace();
  for (const MonitorRow& monitor : structure_.monitors) {
    branch.monitors.push_back({monitor.id, {}});
    branch.rates->monitors.push_back({monitor.id, {}});
  }
  for (const ResolvedFoundation& foundation : model_.foundations)
    branch.contact_fraction.push_back({foundation.id, {}});
  result_.branches.push_back(std::move(branch));
}

void Recorder::add_point(const PathPoint& point) {
  neutral_.note(point.context.holds, user_load(point));
  const OutputOptions& output = analysis_.output;
  if (output.states == StateOutput::all ||
      (output.states == StateOutput::every && points_ % output.every == 0))
    static_cast<void>(add_state(point));
  ++points_;
  observer_.note(point.y, point.lambda, branch_);
  if (branch_ != 0 || !yield_.is_below()) observer_.note_stress(point.y, point.lambda, branch_);
  if (branch_ == 0 && !result_.summary.critical_load_factor)
    observer_.add_to_extremes(point.y, point.lambda, branch_);
  if (branch_ == 0 && !analysis_.start) softest_.set_unloaded(point);
  if (!analysis_.traits().reports_path) return;
  kept_.add(point, softest_.ratio(point));
  if (output.path_points) return;
  kept_.forget_modes();
  if (kept_.are_many()) add_rows(false);
}

void Recorder::add_row(const PathRow& row) {
  const PathPoint& point = row.point;
  Branch& branch = result_.branches.back();
  if (row.computed) branch.computed.push_back(static_cast<int>(branch.load_factor.size()));
  branch.rates->load_factor.push_back(point.tangent_lambda / structure_.scales.load);
  branch.load_factor.push_back(user_load(point));
  branch.arc_length.push_back(point.arc_length);
  branch.negative_eigenvalues.push_back(point.negative);
  const bool is_lost = branch_ == 0 && lost_ == point.arc_length;
  const auto ratio = row.stiffness_ratio ? row.stiffness_ratio : softest_.ratio(point);
  branch.stiffness_ratio.push_back(is_lost ? 0.0 : ratio);
  for (std::size_t i = 0; i < structure_.monitors.size(); ++i) {
    branch.monitors[i].values.push_back(structure_.monitors[i].row.dot(point.y));
    branch.rates->monitors[i].values.push_back(structure_.monitors[i].row.dot(point.tangent));
  }
  if (probe_) {
    const auto found = row.computed ? probe_->at(point.y, point.lambda) : std::nullopt;
    branch.frequencies.push_back(found ? std::optional(probe_->in_units(*found)) : std::nullopt);
    if (found) result_.diagnostics.factorizations += found->factorizations;
  }
  const auto contact = contact_fractions(structure_, point.y);
  for (std::size_t i = 0; i < contact.size(); ++i) branch.contact_fraction[i].values.push_back(contact[i]);
}

/// Adds the rows of the kept points and of points between them.
/// @param last the branch has no more points
void Recorder::add_rows(bool last) {
  const auto monitors = [this](const Eigen::VectorXd& y) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(structure_.monitors.size()));
    for (std::size_t i = 0; i < structure_.monitors.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = structure_.monitors[i].row.dot(y);
    return values;
  };
  const RowVisitor add = [this](const PathRow& row) { add_row(row); };
  missing_rows_ += analysis_.output.path_points
                       ? kept_.spread(solver_, *analysis_.output.path_points, hooks_.stop, add)
                       : kept_.follow(solver_, monitors, last, hooks_.stop, add);
  if (!last) return;
  kept_ = {};
  warn_of_rows(std::exchange(missing_rows_, 0));
}

/// Warns where a branch has fewer rows than were asked for, or than straight lines need.
void Recorder::warn_of_rows(int missing) {
  const int asked = analysis_.output.path_points.value_or(0);
  const auto count = static_cast<int>(result_.branches.back().load_factor.size());
  if (missing == 0 && count >= asked) return;
  const std::string places = std::to_string(missing) + " between them could not be corrected";
  const std::string branch =
      "branch " + std::to_string(branch_) + " has " + std::to_string(count) + " points";
  const std::string why = missing > 0 ? places : "it has no length";
  result_.warnings.push_back(
      {"path_points", asked > 0 ? branch + " for " + std::to_string(asked) + " asked for: " + why
                                : branch + ", and " + places +
                                      ": straight lines may be more than 1 % of the ranges off there"});
}

void Recorder::add_critical(const CriticalEvent& event) {
  CriticalPoint point = critical_point(structure_, event);
  point.branch = branch_;
  const bool grows = grows_from(event);
  if (event.null.size() > 0 && !is_limit(event.type) && !grows) point.imperfection = event.imperfection;
  // the bifurcation beside the path is no equilibrium of the imperfect structure
  const bool passed_by = event.type == CriticalType::broken_bifurcation;
  if (passed_by) point.negative_after = point.negative_before;
  if (!passed_by && analysis_.output.states != StateOutput::none &&
      analysis_.output.states != StateOutput::at_load_factors)
    // the tangent is singular there: Newton's method ends with its bound of the residual
    point.state = add_state(event.point, solver_.options().largest_residual);
  if (event.null.size() > 0 && point.multiplicity == 1 && !grows)
    if (const auto member = member_that_buckles(structure_, event.null.col(0)))
      point.member = model_.members[*member].id;
  if (point.state && analysis_.output.modes)
    point.mode = mode_at(structure_, solver_.problem(), event, analysis_);
  if (!passed_by && analysis_.traits().reports_path) kept_.add_critical(event);
  if (is_loss_of_stability(analysis_, point) && !result_.summary.critical_load_factor) {
    if (!point.state) observer_.add_to_extremes(event.point.y, event.point.lambda, branch_);
    result_.summary.critical_load_factor = point.load_factor;
    result_.summary.critical_type = point.type;
    if (!grows) softest_.lose(event.point);
    if (event.cause == CriticalCause::smooth && !grows) lost_ = event.point.arc_length;
    result_.summary.at_critical = at_critical(structure_, event.point.y);
  }
  result_.critical_points.push_back(std::move(point));
}

void Recorder::on_contact(const ContactChange& change) {
  if (analysis_.traits().reports_path) kept_.add_change(change);
  for (std::size_t i = 0; i < zones_.ids().size(); ++i) {
    if (change.before[i] == change.after[i]) continue;
    ContactEvent event;
    event.branch = branch_;
    event.id = zones_.ids()[i];
    event.opened = change.after[i] < change.before[i];
    event.load_factor = user_load(change.point);
    event.arc_length = change.point.arc_length;
    event.zones_before = change.before[i];
    event.zones_after = change.after[i];
    result_.contact_events.push_back(std::move(event));
  }
}

ZoneCounter Recorder::zone_counter() const {
  if (zones_.ids().empty()) return {};
  return [this](const Eigen::VectorXd& y, std::vector<int>& zones) { zones_.count(y, zones); };
}

void Recorder::end_branch(const char* code) {
  if (result_.branches.empty()) return;
  add_rows(true);
  result_.branches.back().termination = code;
}

void Recorder::finish(bool last) {
  if (last && !analysis_.discretization.fixed_mesh)
    refine_path_states(analysis_, structure_, asked_states_, hooks_.stop, result_);
  if (!refused_.empty() && !result_.failure) fail(result_, "no_convergence", refused_);
  for (std::size_t i = 0; i < reached_.size(); ++i)
    if (!reached_[i]) result_.not_reached.push_back(analysis_.output.at_load_factors[i]);
  if (!result_.not_reached.empty())
    result_.summary.message += "; " + std::to_string(result_.not_reached.size()) + " of " +
                               std::to_string(reached_.size()) + " load factors were not reached";
  yield_.finish(analysis_, last, result_);
  observer_.finish(result_);
}

void Recorder::ask(TraceRules& rules) const {
  if (analysis_.traits().reports_path) rules.zones = zone_counter();
  if (analysis_.output.states != StateOutput::at_load_factors) return;
  for (std::size_t i = 0; i < reached_.size(); ++i)
    rules.asked.loads.push_back({i, analysis_.output.at_load_factors[i] * structure_.scales.load});
}

void Recorder::on_asked(std::size_t row, const PathPoint& state) {
  const std::optional<int> index = add_state(state);
  if (!index) return;
  reached_[row] = 1;
  asked_states_.push_back(
      {static_cast<std::size_t>(*index), state.y, state.lambda, state.negative, state.context});
}

void Recorder::on_point(const PathPoint& point) {
  add_point(point);
  const int step = branch_points_++;
  if (hooks_.on_point)
    hooks_.on_point({branch_, step, user_load(point), point.arc_length, point.negative,
                     monitor_values(structure_, point.y)});
  if (hooks_.on_progress) hooks_.on_progress({branch_, step, user_load(point), point.negative});
}

void Recorder::on_touching(const PathPoint& point) {
  result_.warnings.push_back(
      {"touching_eigenvalue", "a stiffness falls to zero within rounding at load factor " +
                                  number(user_load(point)) +
                                  " and rises again: whether two critical points lie there cannot be told"});
}

void Recorder::on_unpinned(const PathPoint& point) { neutral_.note(point.context.holds, user_load(point)); }

void Recorder::on_critical(const CriticalEvent& event) {
  add_critical(event);
  if (hooks_.on_critical) hooks_.on_critical(result_.critical_points.back());
}

void Recorder::on_step(const PathPoint& from, const PathPoint& to) {
  if (branch_ != 0) return;
  softest_.add_step(from, to);
  yield_.add_step(from, to);
}

}  // namespace snapthrough
