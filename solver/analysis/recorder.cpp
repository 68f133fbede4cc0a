#include "solver/analysis/recorder.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/discrete/structure.h"
#include "solver/events/root_finder.h"
#include "solver/hooks.h"
#include "solver/numeric/number_text.h"
#include "solver/report/critical_point.h"
#include "solver/report/mode.h"
#include "solver/report/result_parts.h"
#include "solver/report/state.h"

namespace snapthrough {

std::vector<NamedValue> Recorder::monitors(const PathPoint& point) const {
  std::vector<NamedValue> out;
  out.reserve(structure_.monitors.size());
  for (const MonitorRow& monitor : structure_.monitors) out.push_back({monitor.id, monitor.row.dot(point.y)});
  return out;
}

double Recorder::user_load(const PathPoint& point) const { return point.lambda / structure_.scales.load; }

int Recorder::add_state(const PathPoint& point) {
  State state = make_state(structure_, model_, point.y, point.lambda, analysis_.output.points_per_member);
  state.branch = branch_;
  result_.states.push_back(std::move(state));
  return static_cast<int>(result_.states.size()) - 1;
}

void Recorder::begin_branch(int branch_number, std::optional<int> parent) {
  branch_ = branch_number;
  branch_points_ = 0;
  neutral_.start(branch_);
  at_branch_start_ = true;
  if (analysis_.type != AnalysisType::path) return;
  Branch branch;
  branch.id = branch_;
  branch.parent = parent;
  for (const MonitorRow& monitor : structure_.monitors) branch.monitors.push_back({monitor.id, {}});
  for (const Foundation& foundation : model_.foundations)
    branch.contact_fraction.push_back({foundation.id, {}});
  result_.branches.push_back(std::move(branch));
}

void Recorder::add_point(const PathPoint& point) {
  neutral_.note(point.holds, user_load(point));
  const OutputOptions& output = analysis_.output;
  if (output.states == StateOutput::all ||
      (output.states == StateOutput::every && points_ % output.every == 0))
    add_state(point);
  ++points_;
  observer_.note_strain(point.y, point.lambda, branch_);
  if (branch_ == 0 && !result_.summary.critical_load_factor)
    observer_.add_to_extremes(point.y, point.lambda, branch_);
  if (branch_ == 0 && !analysis_.start) softest_.set_unloaded(point);
  if (analysis_.type != AnalysisType::path) return;
  if (output.path_points)
    kept_.add(point);
  else
    add_row(point);
}

void Recorder::add_row(const PathPoint& point) {
  Branch& branch = result_.branches.back();
  branch.load_factor.push_back(user_load(point));
  branch.arc_length.push_back(point.arc_length);
  branch.negative_eigenvalues.push_back(point.negative);
  const bool is_lost = branch_ == 0 && lost_ == point.arc_length;
  branch.stiffness_ratio.push_back(is_lost ? 0.0 : softest_.ratio(point));
  for (std::size_t i = 0; i < structure_.monitors.size(); ++i)
    branch.monitors[i].values.push_back(structure_.monitors[i].row.dot(point.y));
  if (probe_) {
    const auto found = probe_->at(point.y, point.lambda);
    branch.frequencies.push_back(found ? std::optional(probe_->in_units(*found)) : std::nullopt);
    if (found) result_.diagnostics.factorizations += found->factorizations;
  }
  const auto contact = contact_fractions(structure_, model_, point.y);
  for (std::size_t i = 0; i < contact.size(); ++i) branch.contact_fraction[i].values.push_back(contact[i]);
}

/// Adds the rows of the stored points and of the points between them.
void Recorder::spread_points() {
  const int asked = *analysis_.output.path_points;
  int missing = 0;
  const std::vector<PathPoint> points = kept_.spread(solver_, asked, hooks_.stop, missing);
  for (const PathPoint& point : points) add_row(point);
  kept_ = {};
  const auto count = static_cast<int>(points.size());
  if (missing == 0 && count >= asked) return;
  result_.warnings.push_back(
      {"path_points", "branch " + std::to_string(branch_) + " has " + std::to_string(count) + " points for " +
                          std::to_string(asked) + " asked for: " +
                          (missing > 0 ? std::to_string(missing) + " between them could not be corrected"
                                       : "it has no length")});
}

void Recorder::add_critical(const CriticalEvent& event) {
  CriticalPoint point = critical_point(structure_, event);
  point.branch = branch_;
  const bool flutters = event.type == CriticalType::flutter;
  if (event.null.size() > 0 && !is_limit(event.type) && !flutters) point.imperfection = event.imperfection;
  // the bifurcation beside the path is no equilibrium of the imperfect structure
  const bool passed_by = event.type == CriticalType::broken_bifurcation;
  if (passed_by) point.negative_after = point.negative_before;
  if (!passed_by && analysis_.output.states != StateOutput::none &&
      analysis_.output.states != StateOutput::at_load_factors)
    point.state = add_state(event.point);
  if (event.null.size() > 0 && point.multiplicity == 1 && !flutters)
    if (const auto member = member_that_buckles(structure_, model_, event.null.col(0)))
      point.member = model_.members[*member].id;
  if (point.state && analysis_.output.modes)
    point.mode = mode_at(structure_, model_, solver_.problem(), event, analysis_);
  if (!passed_by && analysis_.output.path_points && analysis_.type == AnalysisType::path)
    kept_.add_critical(event);
  if (is_loss_of_stability(analysis_, point) && !result_.summary.critical_load_factor) {
    if (!point.state) observer_.add_to_extremes(event.point.y, event.point.lambda, branch_);
    result_.summary.critical_load_factor = point.load_factor;
    result_.summary.critical_type = point.type;
    if (!flutters) softest_.lose(event.point);
    if (event.cause == CriticalCause::smooth && !flutters) lost_ = event.point.arc_length;
    result_.summary.at_critical = at_critical(structure_, model_, event.point.y);
  }
  result_.critical_points.push_back(std::move(point));
}

void Recorder::on_contact(const ContactChange& change) {
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
  if (analysis_.output.path_points) spread_points();
  result_.branches.back().termination = code;
}

void Recorder::finish() {
  for (std::size_t i = 0; i < reached_.size(); ++i)
    if (!reached_[i]) result_.not_reached.push_back(analysis_.output.at_load_factors[i]);
  if (!result_.not_reached.empty())
    result_.summary.message += "; " + std::to_string(result_.not_reached.size()) + " of " +
                               std::to_string(reached_.size()) + " load factors were not reached";
  observer_.finish(result_);
}

void Recorder::add_states_at_loads(const PathPoint& from, const PathPoint& to) {
  for (std::size_t i = 0; i < reached_.size(); ++i) {
    const double target = analysis_.output.at_load_factors[i] * structure_.scales.load;
    const double va = from.lambda - target;
    const double vb = to.lambda - target;
    const double rounding = kSameLoadFactor * std::abs(target);
    if (std::abs(va) <= rounding || std::abs(vb) <= rounding) {
      reached_[i] = 1;
      // the end of a step is the start of the next one and is recorded only once
      if (std::abs(vb) <= rounding) add_state(to);
      if (std::abs(va) <= rounding && at_branch_start_) add_state(from);
      continue;
    }
    if ((va > 0.0) == (vb > 0.0)) continue;
    add_state(point_at_load(solver_, from, to, target));
    reached_[i] = 1;
  }
  at_branch_start_ = false;
}

void Recorder::on_point(const PathPoint& point) {
  add_point(point);
  const int step = branch_points_++;
  if (hooks_.on_point)
    hooks_.on_point({branch_, step, user_load(point), point.arc_length, point.negative, monitors(point)});
  if (hooks_.on_progress) hooks_.on_progress({branch_, step, user_load(point), point.negative});
}

void Recorder::on_touching(const PathPoint& point) {
  result_.warnings.push_back(
      {"touching_eigenvalue", "a stiffness falls to zero within rounding at load factor " +
                                  number(user_load(point)) +
                                  " and rises again: whether two critical points lie there cannot be told"});
}

void Recorder::on_unpinned(const PathPoint& point) { neutral_.note(point.holds, user_load(point)); }

void Recorder::on_critical(const CriticalEvent& event) {
  add_critical(event);
  if (hooks_.on_critical) hooks_.on_critical(result_.critical_points.back());
}

void Recorder::on_step(const PathPoint& from, const PathPoint& to) {
  if (branch_ == 0) softest_.add_step(from, to);
  if (analysis_.output.states == StateOutput::at_load_factors) add_states_at_loads(from, to);
}

}  // namespace snapthrough
