#include "solver/analysis/path_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "solver/numeric/cancelled.h"
#include "solver/numeric/cubic.h"
#include "solver/numeric/rounding.h"
#include "solver/path/segment.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Distances are shares of the ranges that the curves span.
struct CurveLimits {
  static constexpr double cubic =
      5e-4;                             ///< largest estimated error of a cubic, a quarter of what is promised
  static constexpr double line = 6e-3;  ///< largest distance of a cubic from a straight line between rows
  static constexpr int halvings = 12;   ///< corrected points halve a piece so often; a kink takes eight
  static constexpr int lines = 7;       ///< halvings of a cubic between computed points
  static constexpr double least_fraction = 0.05;  ///< least distance of a corrected point from either end
  static constexpr double before_meeting = 0.9;   ///< place on a tangent, over that where tangents meet
  /// Length of a neighbour, over that of a piece, below which it says nothing of the piece.
  static constexpr double short_piece = 0.01;
  /// Sum of the distances of a corrected point from both ends, over their distance, which only a point of
  /// another path exceeds.
  static constexpr double detour = 2.0;
};

/// Cross product in the plane of the first component and another one.
double cross(const VectorXd& a, const VectorXd& b, Eigen::Index k) { return a[0] * b[k] - a[k] * b[0]; }

/// Largest part of an offset across a direction, over the planes of the first component and each other one.
double across(const VectorXd& offset, const VectorXd& direction) {
  double largest = 0.0;
  for (Eigen::Index k = 1; k < offset.size(); ++k) {
    const double along = std::hypot(direction[0], direction[k]);
    const double part =
        along > 0.0 ? std::abs(cross(offset, direction, k)) / along : std::hypot(offset[0], offset[k]);
    largest = std::max(largest, part);
  }
  return largest;
}

}  // namespace

PathCurve::PathCurve(PointSolver& solver, const ShownValues& shown, std::vector<PathPoint> points,
                     ShownRange& range)
    : solver_(solver), shown_(shown) {
  for (PathPoint& point : points) nodes_.push_back({std::move(point), {}, {}, 1.0, 0});
  set_ranges(shown, range);
  for (Node& node : nodes_) set_node(node);
}

VectorXd PathCurve::values_of(const PathPoint& point) const {
  const VectorXd shown = shown_(point.y);
  VectorXd values(std::max<Eigen::Index>(2, shown.size() + 1));
  values[0] = point.lambda;
  if (shown.size() == 0)
    values[1] = point.arc_length;
  else
    values.tail(shown.size()) = shown;
  return values;
}

void PathCurve::set_ranges(const ShownValues& shown, ShownRange& range) {
  if (range.least.size() == 0) range.least = range.most = values_of(nodes_.front().point);
  double largest = 0.0;
  for (const Node& node : nodes_) {
    const VectorXd values = values_of(node.point);
    range.least = range.least.cwiseMin(values);
    range.most = range.most.cwiseMax(values);
    largest = std::max(largest, node.point.y.size() > 0 ? node.point.y.cwiseAbs().maxCoeff() : 0.0);
  }
  ranges_ = range.most - range.least;
  const auto ignore = [this](Eigen::Index k) { ranges_[k] = std::numeric_limits<double>::infinity(); };
  // what only rounding moves
  const VectorXd unit = shown(VectorXd::Constant(nodes_.front().point.y.size(), largest));
  for (Eigen::Index k = 0; k < unit.size(); ++k)
    if (!(ranges_[k + 1] > Rounding::motion * std::abs(unit[k]))) ignore(k + 1);
  if (!(ranges_[0] > 0.0)) ignore(0);
}

void PathCurve::set_node(Node& node) const {
  node.value = values_of(node.point).cwiseQuotient(ranges_);
  node.per_arc = 1.0 / solver_.norm().arc_per_step(node.point);
  PathPoint along;
  along.y = node.point.tangent * node.per_arc;
  along.lambda = node.point.tangent_lambda * node.per_arc;
  along.arc_length = 1.0;
  node.rate = values_of(along).cwiseQuotient(ranges_);
}

VectorXd PathCurve::value_at(const Place& place) const {
  const Node& a = nodes_[place.node];
  const Node& b = nodes_[place.node + 1];
  const double whole = length(place.node);
  const CubicWeights h(place.fraction * whole, whole);
  return h.a * a.value + h.da * a.rate + h.b * b.value + h.db * b.rate;
}

/// Third derivative, by arc length, of the cubic between a node and the next one.
VectorXd PathCurve::third(std::size_t piece) const {
  const Node& a = nodes_[piece];
  const Node& b = nodes_[piece + 1];
  return third_derivative(VectorXd(b.value - a.value), a.rate, b.rate, length(piece));
}

/// Largest distance by which a piece's cubic goes beyond its ends along its chord, but at most the part of an
/// estimated error along it, over the planes of the first component and each other one: where the path turns
/// sharply at an end, a cubic leaves the curve in its own direction.
double PathCurve::beyond_ends(std::size_t piece, const VectorXd& offset) const {
  const VectorXd& first = nodes_[piece].value;
  const VectorXd chord = nodes_[piece + 1].value - first;
  double largest = 0.0;
  for (const double fraction : {0.15, 0.3, 0.5, 0.7, 0.85}) {
    const VectorXd away = value_at({piece, fraction}) - first;
    for (Eigen::Index k = 1; k < chord.size(); ++k) {
      const double size = std::hypot(chord[0], chord[k]);
      const auto along = [&](const VectorXd& of) { return (of[0] * chord[0] + of[k] * chord[k]) / size; };
      if (!(size > 0.0)) continue;
      const double beyond = std::max(-along(away), along(away) - size);
      largest = std::max(largest, std::min(beyond, std::abs(along(offset))));
    }
  }
  return largest;
}

/// Estimated error of a piece's cubic across the curve: by its fourth derivative, the change of the third
/// derivative from a neighbour to the piece. The larger one of both counts, of a neighbour that is too short
/// to tell (both sides of a kink have one between them) the smaller one. The curve has the direction of the
/// cubic's middle, and of the chord where a cubic that is far off turns back. What goes beyond the ends
/// counts too.
double PathCurve::error(std::size_t piece) const {
  const Node& a = nodes_[piece];
  const Node& b = nodes_[piece + 1];
  const double whole = length(piece);
  const VectorXd third = this->third(piece);
  const VectorXd chord = b.value - a.value;
  const VectorXd middle = (1.5 / whole) * chord - 0.25 * (a.rate + b.rate);
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  const auto beside = [&](std::size_t other) {
    const VectorXd fourth = (third - this->third(other)) / (0.5 * (whole + length(other)));
    const VectorXd offset = fourth * (std::pow(whole, 4) / 384.0);
    const double error =
        std::max({across(offset, middle), across(offset, chord), beyond_ends(piece, offset)});
    least = std::min(least, error);
    if (length(other) >= CurveLimits::short_piece * whole) most = std::max(most, error);
  };
  if (piece > 0) beside(piece - 1);
  if (piece + 2 < nodes_.size()) beside(piece + 1);
  return std::max(least, most);
}

/// Arc length from a piece's begin to where its end tangents meet, in the plane where the curve bends most: a
/// kink is there, and the middle of a smooth curve near it.
std::optional<double> PathCurve::meeting_place(std::size_t piece) const {
  const Node& a = nodes_[piece];
  const Node& b = nodes_[piece + 1];
  const VectorXd rise = b.value - a.value;
  double most = 0.0;
  std::optional<double> place;
  for (Eigen::Index k = 1; k < rise.size(); ++k) {
    const double turn = cross(a.rate, b.rate, k);
    const double ahead = cross(rise, b.rate, k) / turn;
    const double back = cross(a.rate, rise, k) / turn;
    if (!(std::abs(turn) > most) || !(ahead > 0.0) || !(back > 0.0)) continue;
    most = std::abs(turn);
    place = ahead / (ahead + back) * length(piece);
  }
  return place;
}

/// A corrected point between the ends of a piece, near the place where their tangents meet; empty: none was
/// found on this path. Where the cubic leads to none, points on both tangents before that place are tried.
std::optional<PathPoint> PathCurve::point_between(std::size_t piece) const {
  const Node& a = nodes_[piece];
  const Node& b = nodes_[piece + 1];
  const double whole = length(piece);
  const double apart = solver_.norm().arc(a.point, b.point);
  const auto checked = [&](std::optional<PathPoint> point) -> std::optional<PathPoint> {
    if (!point) return std::nullopt;
    const double before = solver_.norm().arc(a.point, *point);
    const double after = solver_.norm().arc(*point, b.point);
    if (!(before + after < CurveLimits::detour * apart)) return std::nullopt;
    point->arc_length = a.point.arc_length + before / (before + after) * whole;
    if (point->arc_length > a.point.arc_length && point->arc_length < b.point.arc_length) return point;
    return std::nullopt;
  };
  const Segment segment(solver_, a.point, b.point);
  const auto meeting = meeting_place(piece);
  const double place = meeting.value_or(0.5 * whole);
  const double fraction =
      std::clamp(place / whole, CurveLimits::least_fraction, 1.0 - CurveLimits::least_fraction);
  if (auto point = checked(segment.point_at(fraction))) return point;
  if (!meeting) return std::nullopt;
  // in the plane normal to the tangent: that normal to the chord may touch the path where it turns sharply
  const auto on_tangent = [&](const Node& from, double arc) {
    PathPoint guess = from.point;
    guess.y += arc * from.per_arc * from.point.tangent;
    guess.lambda += arc * from.per_arc * from.point.tangent_lambda;
    const double size = std::hypot(from.point.tangent.norm(), from.point.tangent_lambda);
    const Segment along(solver_, a.point, b.point, from.point.tangent / size,
                        from.point.tangent_lambda / size);
    return checked(along.point_near(std::move(guess)));
  };
  if (auto point = on_tangent(a, CurveLimits::before_meeting * place)) return point;
  return on_tangent(b, -CurveLimits::before_meeting * (whole - place));
}

/// Corrects a point on a piece; false when none was found on this path.
bool PathCurve::split(std::size_t piece) {
  Node& from = nodes_[piece];
  if (from.halvings >= CurveLimits::halvings) return false;
  auto point = point_between(piece);
  if (!point) return false;
  Node node{*std::move(point), {}, {}, 1.0, ++from.halvings};
  set_node(node);
  nodes_.insert(nodes_.begin() + static_cast<std::ptrdiff_t>(piece) + 1, std::move(node));
  return true;
}

int PathCurve::refine(const CurvePart& part, const std::stop_token& stop) {
  int missing = 0;
  for (std::size_t piece = 0; piece + 1 < nodes_.size();) {
    const bool inside =
        nodes_[piece + 1].point.arc_length > part.beyond && nodes_[piece + 1].point.arc_length <= part.to;
    const double off = inside ? error(piece) : 0.0;
    bool done = false;
    if (off > CurveLimits::cubic && !stop.stop_requested() &&
        unless_cancelled([&] { done = split(piece); }) && done)
      continue;
    if (off > CurveLimits::line) ++missing;
    ++piece;
  }
  return missing;
}

/// Adds the fractions of a piece between two others at which straight lines need a row.
void PathCurve::add_between(std::size_t piece, double from, double to, int depth,
                            std::vector<double>& fractions) const {
  const VectorXd first = value_at({piece, from});
  const VectorXd chord = value_at({piece, to}) - first;
  double largest = 0.0;
  for (const double share : {0.25, 0.5, 0.75}) {
    const VectorXd offset = value_at({piece, from + share * (to - from)}) - first;
    largest = std::max(largest, across(offset, chord));
  }
  if (largest <= CurveLimits::line || depth >= CurveLimits::lines) return;
  const double middle = 0.5 * (from + to);
  add_between(piece, from, middle, depth + 1, fractions);
  fractions.push_back(middle);
  add_between(piece, middle, to, depth + 1, fractions);
}

PathPoint PathCurve::point_at(const Place& place) const {
  const PathPoint& a = nodes_[place.node].point;
  const PathPoint& b = nodes_[place.node + 1].point;
  const double whole = length(place.node);
  const CubicWeights h(place.fraction * whole, whole);
  const double da = h.da * nodes_[place.node].per_arc;
  const double db = h.db * nodes_[place.node + 1].per_arc;
  PathPoint point;
  point.y = h.a * a.y + da * a.tangent + h.b * b.y + db * b.tangent;
  point.lambda = h.a * a.lambda + da * a.tangent_lambda + h.b * b.lambda + db * b.tangent_lambda;
  point.arc_length = a.arc_length + place.fraction * whole;
  point.negative = a.negative;
  point.context = a.context;
  set_rate(point);
  return point;
}

void PathCurve::set_rate(PathPoint& point) const {
  const auto beyond =
      std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, point.arc_length,
                       [](double arc, const Node& node) { return arc < node.point.arc_length; });
  const Node& a = *(beyond - 1);
  const Node& b = *beyond;
  const double whole = b.point.arc_length - a.point.arc_length;
  const CubicRates h((point.arc_length - a.point.arc_length) / whole, whole);
  const double da = h.da * a.per_arc;
  const double db = h.db * b.per_arc;
  point.tangent = h.rise * (b.point.y - a.point.y) + da * a.point.tangent + db * b.point.tangent;
  point.tangent_lambda =
      h.rise * (b.point.lambda - a.point.lambda) + da * a.point.tangent_lambda + db * b.point.tangent_lambda;
}

void PathCurve::rows(const CurvePart& part, std::vector<PathPoint>& passed, const RowVisitor& visit) const {
  auto next = passed.begin();
  const auto is_inside = [&part](const PathPoint& point) {
    return point.arc_length > part.beyond && point.arc_length <= part.to;
  };
  const auto show = [&](PathRow&& row) {
    for (; next != passed.end() && next->arc_length <= row.point.arc_length; ++next) {
      if (!is_inside(*next)) continue;
      set_rate(*next);
      PathRow one{std::move(*next)};
      visit(one);
    }
    if (is_inside(row.point)) visit(row);
  };
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    PathRow row{nodes_[i].point, true};
    row.point.tangent *= nodes_[i].per_arc;
    row.point.tangent_lambda *= nodes_[i].per_arc;
    show(std::move(row));
    if (i + 1 == nodes_.size() || !is_inside(nodes_[i + 1].point)) continue;
    std::vector<double> fractions;
    add_between(i, 0.0, 1.0, 0, fractions);
    for (const double fraction : fractions) show({point_at({i, fraction}), false});
  }
}

}  // namespace snapthrough
