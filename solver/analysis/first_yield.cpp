#include "solver/analysis/first_yield.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "solver/accuracy/static_states.h"
#include "solver/events/root_finder.h"
#include "solver/numeric/bracket.h"
#include "solver/numeric/number_text.h"
#include "solver/report/result_parts.h"

namespace snapthrough {
namespace {

/// Numbers of the search; shares of the strength where no unit is given.
struct YieldLimits {
  /// Stress at an end of a step from which states between its ends are looked at: a stress that rises from
  /// less to the strength and falls again on one step is not seen.
  static constexpr double near = 0.5;
  static constexpr int parts = 4;             ///< parts of a step on which the stress may rise and fall again
  static constexpr double closed = 1e-10;     ///< stress over strength, minus one, that counts as none
  static constexpr double least_step = 1e-9;  ///< length of a bracket over that of its step that is one place
  static constexpr int most_loads = 100;      ///< states at loads that are solved for
  static constexpr double least_share = 1e-5;  ///< least distance of such a load from the ends of its bracket
  static constexpr int most_meshes = 6;        ///< load factors that are taken to finer meshes
  /// Change of the load factor that ends the search on finer meshes, over the accuracy.
  static constexpr double settled = 0.1;
};

double size_of(const std::optional<MemberUtilisation>& at) { return at ? std::abs(at->place.value) : 0.0; }

}  // namespace

/// Largest stress over strength, minus one.
double FirstYieldSearch::excess(const PathPoint& point) const {
  return size_of(largest_utilisation(structure_, point.y, point.lambda)) - 1.0;
}

/// A state with its excess.
FirstYieldSearch::Stressed FirstYieldSearch::stressed(const PathPoint& point) const {
  return {point, excess(point)};
}

/// The first state beyond first yield among those at the inner ends of equal parts of a step; empty: none is.
std::optional<FirstYieldSearch::Stressed> FirstYieldSearch::first_beyond(const PathPoint& from,
                                                                         const PathPoint& to) const {
  const Segment segment(solver_, from, to);
  for (int part = 1; part < YieldLimits::parts; ++part) {
    const double fraction = static_cast<double>(part) / YieldLimits::parts;
    PathPoint estimate = from;
    segment.interpolate(fraction, estimate);
    if (excess(estimate) < 0.0) continue;
    const std::optional<PathPoint> point = segment.point_at(fraction);
    if (!point) continue;
    if (Stressed found = stressed(*point); found.excess >= 0.0) return found;
  }
  return std::nullopt;
}

/// The state at first yield on the path from one below it to one beyond; empty: not found.
std::optional<PathPoint> FirstYieldSearch::on_segment(const Stressed& from, const Stressed& beyond) const {
  const Segment segment(solver_, from.point, beyond.point);
  const double length = segment.length();
  const PathNorm& norm = solver_.norm();
  const LocatedRoot root = find_root(segment, from.excess, beyond.excess,
                                     {[this](const PathPoint& point) { return excess(point); },
                                      [&](const PathPoint& a, const PathPoint& b, double least) {
                                        return least <= YieldLimits::closed ||
                                               norm.distance(a, b) <= YieldLimits::least_step * length;
                                      }});
  return root.found ? std::optional(root.root) : std::nullopt;
}

/// Finds the state at first yield by states at loads between theirs: where contact changes everywhere on a
/// step, places along it may have no state.
std::optional<PathPoint> FirstYieldSearch::by_load(Stressed from, Stressed beyond) const {
  SignBracket bracket(from.point.lambda, from.excess, beyond.point.lambda, beyond.excess);
  for (int i = 0; i < YieldLimits::most_loads && from.point.lambda != beyond.point.lambda; ++i) {
    const double load = bracket.next(YieldLimits::least_share);
    const std::optional<PathPoint> point = point_at_load(solver_, from.point, beyond.point, load);
    if (!point) return std::nullopt;
    Stressed found = stressed(*point);
    bracket.take(load, found.excess);
    const bool is_closed = bracket.width() <= kSameLoadFactor * std::abs(load);
    if (std::abs(found.excess) <= YieldLimits::closed || is_closed) return point;
    (found.excess < 0.0 ? from : beyond) = std::move(found);
  }
  return std::nullopt;
}

/// Finds the state at first yield between one below it and one beyond, or notes their loads.
void FirstYieldSearch::locate(const Stressed& from, const Stressed& beyond) {
  is_over_ = true;
  std::optional<PathPoint> point = on_segment(from, beyond);
  if (!point) point = by_load(from, beyond);
  const auto at = point ? largest_utilisation(structure_, point->y, point->lambda) : std::nullopt;
  if (!at) {
    between_ = {from.point.lambda, beyond.point.lambda};
    return;
  }
  const double rate = (beyond.excess - from.excess) / (beyond.point.lambda - from.point.lambda);
  found_ = {*std::move(point), *at, rate};
}

void FirstYieldSearch::add_step(const PathPoint& from, const PathPoint& to) {
  if (is_over_) return;
  const Stressed before{from, before_ ? *before_ : excess(from)};
  const Stressed after = stressed(to);
  before_ = after.excess;
  if (before.excess > 0.0) {
    is_over_ = true;  // the path begins beyond first yield
    return;
  }
  std::optional<Stressed> beyond;
  if (std::max(before.excess, after.excess) + 1.0 > YieldLimits::near) beyond = first_beyond(from, to);
  if (!beyond && after.excess >= 0.0) beyond = after;
  if (beyond) locate(before, *beyond);
}

FirstYield FirstYieldSearch::described(const PathPoint& state, const MemberUtilisation& at) const {
  FirstYield out;
  out.load_factor = state.lambda / structure_.scales.load;
  out.arc_length = state.arc_length;
  out.member = at.member;
  out.place = at.place;
  out.place.value = std::copysign(1.0, at.place.value);
  out.monitors = monitor_values(structure_, state.y);
  return out;
}

/// Takes the load factor to finer meshes: on each the state at the last load factor tells by how much its
/// stress differs from the strength, and so by how much the load factor changes.
void FirstYieldSearch::refine(const Analysis& analysis, FirstYield& yield, Result& result) {
  const Discretization& asked = analysis.discretization;
  PathPoint point = found_->state;
  // points of a path are corrected as far as their tangents need it
  if (!solver_.correct_at_load(std::max(solver_.norm().metric().norm(point.y, 0.0), kRoundingResidual),
                               point))
    return;
  struct Tried {
    double lambda, missing;  ///< load, and what its stress over strength lacks to one
  };
  std::optional<Tried> before;
  for (int i = 0; i < YieldLimits::most_meshes; ++i) {
    const StaticState state{0, point.y, point.lambda, point.negative, point.context};
    const RefinedStates refined = refine_states(asked, structure_, {state}, no_other_states);
    result.diagnostics.factorizations += refined.factorizations;
    if (!refined.error || *refined.error > asked.accuracy) return;
    const StaticState& finer = refined.states.front();
    const auto at = largest_utilisation(*refined.structure, finer.y, finer.lambda);
    if (!at) return;
    const double missing = 1.0 - size_of(at);
    if (before && missing != before->missing)
      found_->rate = (before->missing - missing) / (point.lambda - before->lambda);
    before = {point.lambda, missing};
    const double change = missing / found_->rate;
    const double load = point.lambda + change;
    if (std::abs(change) <= YieldLimits::settled * asked.accuracy * std::abs(load)) {
      const double error = std::max(std::abs(change), *refined.error / std::abs(found_->rate));
      yield.load_factor = load / structure_.scales.load;
      yield.member = at->member;
      yield.place = at->place;
      yield.place.value = std::copysign(1.0, at->place.value);
      yield.error_estimate = error / std::abs(load);
      return;
    }
    std::optional<PathPoint> moved = moved_to_load(solver_, load, point);
    if (!moved) return;
    point = *std::move(moved);
  }
}

void FirstYieldSearch::finish(const Analysis& analysis, bool accurate, Result& result) {
  const auto user_load = [this](double lambda) { return number(lambda / structure_.scales.load); };
  const auto warn = [&result](const std::string& text) {
    result.warnings.push_back({"state_accuracy", text});
  };
  if (between_)
    warn("first yield lies between the load factors " + user_load((*between_)[0]) + " and " +
         user_load((*between_)[1]) + ", where its state was not found");
  if (!found_) return;
  FirstYield yield = described(found_->state, found_->at);
  const bool refines = accurate && !analysis.discretization.fixed_mesh;
  if (refines) refine(analysis, yield, result);
  if (refines && !yield.error_estimate)
    warn("the state at first yield, load factor " + user_load(found_->state.lambda) +
         ", is not confirmed by finer meshes");
  result.first_yield = std::move(yield);
}

}  // namespace snapthrough
