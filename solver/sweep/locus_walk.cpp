#include "solver/sweep/locus_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/numeric/bracket.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Numbers of the steps along a curve of critical points; lengths in the locus norm, in which the range of
/// the values has the length one.
struct WalkLimits {
  static constexpr double first = 0.01;   ///< length of the first step
  static constexpr double longest = 0.1;  ///< length of the longest step
  static constexpr double shortest = 1e-7;
  static constexpr double turn = 0.3;    ///< largest angle between the directions of a step's ends, rad
  static constexpr double smooth = 0.1;  ///< angle below which steps become longer, rad
  static constexpr double growth = 1.5;
  static constexpr int steps = 5000;      ///< most steps of a curve
  static constexpr int located = 40;      ///< most evaluations that locate a special point
  static constexpr double width = 1e-12;  ///< width of its bracket, over the step
  static constexpr double least = 1e-3;   ///< least share of a bracket that an evaluation takes off
};

LocusDirection difference(const LocusPoint& a, const LocusPoint& b) {
  return {b.y - a.y, b.lambda - a.lambda, b.t - a.t};
}

void move(LocusPoint& point, const LocusDirection& along, double distance) {
  point.y += distance * along.y;
  point.lambda += distance * along.lambda;
  point.t += distance * along.t;
}

}  // namespace

LocusPiece::LocusPiece(const LocusMetric& metric, const LocusPoint& from, const LocusPoint& to)
    : metric_(metric),
      from_(from),
      to_(to),
      length_(metric.inner(difference(from, to), from.direction)),
      cosine_(metric.inner(from.direction, to.direction)) {}

LocusPoint LocusPiece::interpolated(double s) const {
  const double x = s / length_;
  const double h1 = x * x * (3.0 - 2.0 * x);
  const double m0 = s * (1.0 - x) * (1.0 - x);
  const double m1 = s * x * (x - 1.0) / cosine_;
  LocusPoint out = from_;
  move(out, difference(from_, to_), h1);
  move(out, from_.direction, m0);
  move(out, to_.direction, m1);
  out.null = (1.0 - x) * from_.null + x * to_.null;
  out.null /= metric_.path.norm(out.null, 0.0);
  out.unfolding = 0.0;
  return out;
}

std::optional<LocusPoint> LocusWalk::point_at(const LocusPiece& piece, double s) {
  LocusPoint point = piece.interpolated(s);
  point.direction = piece.from().direction;
  if (!solver_.solve(LocusSide::in_plane, options_, point)) return std::nullopt;
  return point;
}

/// The point at a bound of the values, near `from`.
std::optional<LocusPoint> LocusWalk::at_bound(const LocusPoint& from, double bound) {
  LocusPoint point = from;
  move(point, from.direction, (bound - from.t) / from.direction.t);
  point.t = bound;
  if (!solver_.solve(LocusSide::at_parameter, options_, point)) return std::nullopt;
  const double cosine = metric_.inner(point.direction, from.direction);
  return cosine > std::cos(WalkLimits::turn) ? std::optional(std::move(point)) : std::nullopt;
}

/// One accepted step; `step` is the length to try, and then that of the next one. Empty: no step is short
/// enough.
std::optional<LocusPoint> LocusWalk::advance(const LocusPoint& from, double& step) {
  for (; step >= WalkLimits::shortest; step *= 0.5) {
    LocusPoint to = from;
    move(to, from.direction, step);
    to.unfolding = 0.0;
    const double bound = to.t > family_.highest() ? family_.highest() : family_.lowest();
    if (to.t > family_.highest() || to.t < family_.lowest()) {
      if (auto last = at_bound(from, bound)) return last;
      continue;
    }
    if (!solver_.solve(LocusSide::in_plane, options_, to)) continue;
    const double angle = std::acos(std::clamp(metric_.inner(from.direction, to.direction), -1.0, 1.0));
    if (!(angle <= WalkLimits::turn) || std::abs(to.others - from.others) > 1 || to.t > family_.highest() ||
        to.t < family_.lowest())
      continue;
    if (angle < WalkLimits::smooth) step = std::min(WalkLimits::growth * step, WalkLimits::longest);
    return to;
  }
  return std::nullopt;
}

/// Closes a bracket round the zero of a function of the curve's point.
template <class Function>
std::optional<LocusPoint> LocusWalk::locate(const LocusPiece& piece, double at_from, double at_to,
                                            const Function& function) {
  if (!(at_from * at_to < 0.0)) return std::nullopt;
  SignBracket bracket(0.0, at_from, piece.length(), at_to);
  for (int n = 0;
       n < WalkLimits::located && bracket.width() > WalkLimits::width * piece.length() && !bracket.is_exact();
       ++n) {
    const double s = bracket.next(WalkLimits::least);
    const auto point = point_at(piece, s);
    if (!point) break;
    bracket.take(s, function(*point));
  }
  return point_at(piece, bracket.best());
}

/// Stiffness of the softest motion besides the null motion.
double LocusWalk::other_stiffness(LocusPoint point) {
  return solver_.solve(LocusSide::at_parameter, options_, point) ? solver_.softest_other()
                                                                 : std::numeric_limits<double>::quiet_NaN();
}

/// Special points between two points, in the order of the curve.
std::vector<LocusWalk::Special> LocusWalk::special_points(const LocusPoint& from, const LocusPoint& to) {
  std::vector<Special> found;
  const LocusPiece piece(metric_, from, to);
  const auto add = [&](LocusEventType type, std::optional<LocusPoint> point) {
    if (point) found.push_back({type, *std::move(point)});
  };
  if (!from.bifurcation && from.bend * to.bend < 0.0)
    add(LocusEventType::cusp,
        locate(piece, from.bend, to.bend, [](const LocusPoint& point) { return point.bend; }));
  if (!from.bifurcation && from.load_work * to.load_work < 0.0)
    add(LocusEventType::fold_bifurcation,
        locate(piece, from.load_work, to.load_work, [](const LocusPoint& point) { return point.load_work; }));
  if (from.bifurcation && from.direction.t * to.direction.t < 0.0)
    add(LocusEventType::turn, locate(piece, from.direction.t, to.direction.t,
                                     [](const LocusPoint& point) { return point.direction.t; }));
  if (from.others != to.others)
    add(LocusEventType::fold_bifurcation,
        locate(piece, other_stiffness(from), other_stiffness(to),
               [this](const LocusPoint&) { return solver_.softest_other(); }));
  std::sort(found.begin(), found.end(), [&](const Special& a, const Special& b) {
    return metric_.inner(difference(from, a.point), from.direction) <
           metric_.inner(difference(from, b.point), from.direction);
  });
  return found;
}

/// The point of a piece, on which the coordinate is monotonic, at a coordinate.
std::optional<LocusPoint> LocusWalk::at_value(const LocusPiece& piece, double t) {
  const double sense = piece.to().t > piece.from().t ? 1.0 : -1.0;
  const double s =
      bisect(0.0, piece.length(), 0.0, [&](double x) { return sense * (piece.interpolated(x).t - t) > 0.0; });
  LocusPoint point = piece.interpolated(s);
  point.t = t;
  LocusOptions options = options_;
  options.directions = false;
  const double bend = piece.from().bend + piece.to().bend;
  if (solver_.solve(LocusSide::at_parameter, options, point) &&
      (point.bifurcation || point.bend * bend > 0.0))
    return point;
  // beside a cusp the coordinate alone does not tell the two limit points apart
  return locate(piece, piece.from().t - t, piece.to().t - t, [t](const LocusPoint& at) { return at.t - t; });
}

void LocusWalk::add_load(std::size_t index, const LocusPoint& point, LocusCurve& curve) const {
  curve.loads.push_back({index, point.lambda / load_scale_, point.type()});
}

/// Adds the values beyond `from`, up to and with `to`.
void LocusWalk::add_values(const LocusPoint& from, const LocusPoint& to, LocusCurve& curve) {
  const LocusPiece piece(metric_, from, to);
  std::vector<std::size_t> passed;
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const double t = coordinates_[i];
    if (to.t > from.t ? t > from.t && t <= to.t : t < from.t && t >= to.t) passed.push_back(i);
  }
  std::sort(passed.begin(), passed.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(coordinates_[a] - from.t) < std::abs(coordinates_[b] - from.t);
  });
  for (const std::size_t i : passed) {
    if (coordinates_[i] == to.t) {
      add_load(i, to, curve);
    } else if (const auto point = at_value(piece, coordinates_[i])) {
      add_load(i, *point, curve);
    } else {
      curve.events.push_back(
          {LocusEventType::not_followed, family_.value_at(coordinates_[i]), from.lambda / load_scale_});
    }
  }
}

/// Adds the values and the special points of a step.
void LocusWalk::add_piece(const LocusPoint& from, const LocusPoint& to, LocusCurve& curve) {
  const std::vector<Special> special = special_points(from, to);
  const LocusPoint* last = &from;
  for (const Special& one : special) {
    add_values(*last, one.point, curve);
    curve.events.push_back({one.type, family_.value_at(one.point.t), one.point.lambda / load_scale_});
    last = &one.point;
  }
  add_values(*last, to, curve);
}

std::optional<LocusCurve> LocusWalk::run(LocusPoint point, std::size_t index, const std::stop_token& stop,
                                         int& steps) {
  point.t = coordinates_[index];
  if (!solver_.solve(LocusSide::at_parameter, options_, point)) return std::nullopt;
  const double inwards = index == 0 ? coordinates_.back() - point.t : coordinates_.front() - point.t;
  if (point.direction.t * inwards < 0.0) {
    LocusDirection& way = point.direction;
    way = {-way.y, -way.lambda, -way.t};
  }
  LocusCurve curve;
  curve.bifurcation = point.bifurcation;
  add_load(index, point, curve);
  double step = WalkLimits::first;
  curve.end = LocusEnd::steps;
  for (int n = 0; n < WalkLimits::steps; ++n) {
    if (stop.stop_requested()) {
      curve.end = LocusEnd::cancelled;
      break;
    }
    auto next = advance(point, step);
    if (!next) {
      curve.end = LocusEnd::not_followed;
      break;
    }
    ++steps;
    add_piece(point, *next, curve);
    point = *std::move(next);
    if (point.t == coordinates_.front() || point.t == coordinates_.back()) {
      curve.end = point.t == coordinates_.front() ? LocusEnd::first_value : LocusEnd::last_value;
      break;
    }
  }
  if (curve.end == LocusEnd::not_followed || curve.end == LocusEnd::steps)
    curve.events.push_back(
        {LocusEventType::not_followed, family_.value_at(point.t), point.lambda / load_scale_});
  return curve;
}

}  // namespace snapthrough
