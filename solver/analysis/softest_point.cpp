#include "solver/analysis/softest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "solver/discrete/element_reader.h"
#include "solver/numeric/cubic.h"
#include "solver/numeric/number_text.h"
#include "solver/path/segment.h"
#include "solver/report/mode.h"
#include "solver/report/strain.h"

namespace snapthrough {
namespace {

/// Numbers of the search for the least stiffness; ratios without unit. Source: docs/decisions/0019.
struct SoftestSearch {
  /// Stiffness over the unloaded structure's below which a structure counts as nearly unstable: a small force
  /// along the softest motion then displaces it ten times as far as in the unloaded state.
  static constexpr double nearly_unstable = 0.1;
  static constexpr double least_share = 0.1;    ///< least distance of a trial from either end of the bracket
  static constexpr int trials = 8;              ///< corrected points in a bracket of the minimum
  static constexpr int trials_to_critical = 4;  ///< corrected points before a critical point
  /// Zero of the tangent, over the distance to the critical point, below which the stiffness has an
  /// inflection.
  static constexpr double straight = 0.7;
  static constexpr double same_load = 1e-3;       ///< relative width of the final bracket, in load
  static constexpr double same_stiffness = 1e-2;  ///< relative uncertainty of the least stiffness
};

/// Index of the softest mode of a point; empty when modes are unknown or fewer than the negative eigenvalues.
std::optional<Eigen::Index> least_mode(const PathPoint& point) {
  if (!point.modes || point.modes->count() <= point.negative) return std::nullopt;
  Eigen::Index mode = 0;
  point.modes->stiffness.minCoeff(&mode);
  return mode;
}

/// Least stiffness at a point, and its derivative with respect to arc length.
struct Stiffness {
  double value = 0.0;
  double rate = 0.0;
};

std::optional<Stiffness> stiffness_of(const PathPoint& point) {
  const auto mode = least_mode(point);
  if (!mode || point.modes->rate.size() <= *mode) return std::nullopt;
  return Stiffness{point.modes->stiffness[*mode], point.modes->rate[*mode]};
}

/// Intersection of the tangents at both ends: lower bound of a convex function on the interval.
double lower_bound(const Stiffness& a, const Stiffness& b, double length) {
  if (!(a.rate < 0.0 && b.rate > 0.0)) return -std::numeric_limits<double>::infinity();
  const double place = (b.value - a.value - b.rate * length) / (a.rate - b.rate);
  return a.value + a.rate * place;
}

/// Position in [0, 1] of the minimum of the cubic Hermite interpolant between a and b.
double place_of_minimum(const Stiffness& a, const Stiffness& b, double length) {
  const Cubic cubic{a.value, length * a.rate, b.value, length * b.rate};
  return std::clamp(cubic.minimum().value_or(0.5), SoftestSearch::least_share,
                    1.0 - SoftestSearch::least_share);
}

std::string warning_text(const Softest& softest, const Summary& summary, const std::string& motion) {
  std::string text = "nearly unstable: at load factor " + number(softest.load_factor) +
                     " the least stiffness is " + rounded(softest.stiffness_ratio) +
                     " of the unloaded structure's, and the motion with it " + motion +
                     "; use this load factor";
  if (summary.critical_load_factor)
    text += ", not the critical load factor " + number(*summary.critical_load_factor);
  if (!summary.at_critical) return text + ", unless the displacements beyond it are acceptable";
  return text + ", unless displacements of " + rounded(summary.at_critical->displacement) + " (" +
         rounded(summary.at_critical->relative_displacement) +
         " of the structure's size), which it has there, are acceptable";
}

}  // namespace

void SoftestPoint::set_unloaded(const PathPoint& unloaded) {
  const auto mode = least_mode(unloaded);
  if (unloaded_ != 0.0 || !mode) return;
  unloaded_ = std::max(0.0, unloaded.modes->stiffness[*mode]);
}

std::optional<double> SoftestPoint::ratio(const PathPoint& point) const {
  const auto mode = least_mode(point);
  if (!mode || !(unloaded_ > 0.0)) return std::nullopt;
  return point.modes->stiffness[*mode] / unloaded_;
}

void SoftestPoint::add_step(const PathPoint& from, const PathPoint& to) {
  if (ended_) return;
  if (critical_) {
    ended_ = true;
    search_before_critical(from);
    return;
  }
  if (from.negative > 0 || to.negative > 0) return;
  if (lowest_ && ratio(*lowest_).value_or(1.0) < SoftestSearch::nearly_unstable) return;
  const auto a = stiffness_of(from);
  const auto b = stiffness_of(to);
  if (!a || !b || !(a->rate < 0.0)) return;
  if (!(b->rate > 0.0 || b->value > a->value)) {
    search_before_fall(from, to);
    return;
  }
  if (lowest_ && lower_bound(*a, *b, solver_.norm().distance(from, to)) >= stiffness_of(*lowest_)->value)
    return;
  search(from, to);
}

void SoftestPoint::search_before_fall(const PathPoint& from, const PathPoint& to) {
  const auto a = stiffness_of(from);
  const auto b = stiffness_of(to);
  const double length = solver_.norm().distance(from, to);
  const Cubic cubic{a->value, length * a->rate, b->value, length * b->rate};
  const auto steepest = cubic.inflection();
  if (!steepest || cubic.slope(*steepest) <= 0.0) return;
  auto middle = Segment(solver_, from, to).point_at(*steepest);
  if (!middle) return;
  solver_.find_modes(*middle, from.modes);
  const auto m = stiffness_of(*middle);
  if (m && middle->negative == 0 && m->rate > 0.0) search(from, *std::move(middle));
}

void SoftestPoint::search_before_critical(PathPoint from) {
  for (int i = 0; i < SoftestSearch::trials_to_critical; ++i) {
    const auto a = stiffness_of(from);
    if (!a || from.negative > 0 || !(a->rate < 0.0)) return;
    if (lowest_ && ratio(*lowest_).value_or(1.0) < SoftestSearch::nearly_unstable) return;
    const double share = a->value / (-a->rate * solver_.norm().distance(from, *critical_));
    if (!(share < SoftestSearch::straight)) return;
    auto middle = Segment(solver_, from, *critical_).point_at(std::max(share, SoftestSearch::least_share));
    if (!middle) return;
    solver_.find_modes(*middle, from.modes);
    const auto m = stiffness_of(*middle);
    if (m && middle->negative == 0 && m->rate > 0.0) {
      search(std::move(from), *std::move(middle));
      return;
    }
    from = *std::move(middle);
  }
}

void SoftestPoint::search(PathPoint low, PathPoint high) {
  for (int i = 0; i < SoftestSearch::trials; ++i) {
    const auto a = stiffness_of(low);
    const auto b = stiffness_of(high);
    const double length = solver_.norm().distance(low, high);
    const double least = std::min(a->value, b->value);
    const bool is_near = std::abs(high.lambda - low.lambda) <=
                         SoftestSearch::same_load * std::max(std::abs(low.lambda), std::abs(high.lambda));
    if (is_near && lower_bound(*a, *b, length) >= (1.0 - SoftestSearch::same_stiffness) * least) break;
    auto middle = Segment(solver_, low, high).point_at(place_of_minimum(*a, *b, length));
    if (!middle) break;
    solver_.find_modes(*middle, low.modes);
    const auto m = stiffness_of(*middle);
    if (!m || middle->negative > 0) break;
    const bool is_before = m->rate < 0.0 && m->value <= a->value;
    (is_before ? low : high) = *std::move(middle);
  }
  PathPoint& best = stiffness_of(low)->value <= stiffness_of(high)->value ? low : high;
  // a stiffness below zero where no eigenvalue of the tangent is negative is what rounding makes of it
  if (stiffness_of(best)->value < 0.0) return;
  if (!lowest_ || stiffness_of(best)->value < stiffness_of(*lowest_)->value) lowest_ = std::move(best);
}

void SoftestPoint::report(const Structure& structure, const Analysis& analysis, Result& result) const {
  const ResolvedModel& model = *structure.model;
  const bool with_mode = analysis.output.modes && analysis.output.states != StateOutput::none;
  Summary& summary = result.summary;
  const auto least = lowest_ ? ratio(*lowest_) : std::nullopt;
  if (!least) {
    if (!summary.critical_load_factor) return;
    Softest softest{*summary.critical_load_factor, 0.0, {}};
    const auto point = std::find_if(
        result.critical_points.begin(), result.critical_points.end(),
        [&](const CriticalPoint& one) { return one.load_factor == softest.load_factor && one.mode; });
    if (with_mode && point != result.critical_points.end()) softest.mode = point->mode;
    summary.softest = std::move(softest);
    return;
  }
  Mode mode = mode_displacements(structure, lowest_->modes->motions.col(*least_mode(*lowest_)),
                                 analysis.output.points_per_member);
  scale_to_largest(mode);
  Softest softest{lowest_->lambda / structure.scales.load, *least, {}};
  if (*least < SoftestSearch::nearly_unstable) {
    const std::string text = warning_text(softest, summary, motion_text(mode, model));
    result.warnings.push_back({"nearly_unstable", text});
    summary.message = text + "; " + summary.message;
  }
  if (with_mode) softest.mode = std::move(mode);
  summary.softest = std::move(softest);
}

AtCritical at_critical(const Structure& structure, const Eigen::VectorXd& y) {
  AtCritical out;
  std::array<double, 2> least{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  std::array<double, 2> most{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  for (std::size_t e = 0; e < structure.mesh.elements.size(); ++e) {
    const MeshElement& cell = structure.mesh.elements[e];
    const AxisCurve& axis = *structure.axes[static_cast<std::size_t>(cell.member)];
    const ElementReader reader(structure, y, static_cast<int>(e));
    for (const double xi : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const auto u = reader.displacement(xi);
      out.displacement = std::max(out.displacement, structure.scales.length * std::hypot(u[0], u[1]));
      out.rotation = std::max(out.rotation, std::abs(u[2]));
      const AxisPoint at = axis.at((cell.from + xi * (cell.to - cell.from)) * axis.length());
      least = {std::min(least[0], at.x), std::min(least[1], at.y)};
      most = {std::max(most[0], at.x), std::max(most[1], at.y)};
    }
  }
  out.relative_displacement = out.displacement / std::hypot(most[0] - least[0], most[1] - least[1]);
  LargestStrain strain;
  static_cast<void>(StrainGauge(structure).raise(y, strain));
  out.strain = strain.strain;
  return out;
}

}  // namespace snapthrough
