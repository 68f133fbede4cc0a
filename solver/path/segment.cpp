#include "solver/path/segment.h"

#include <algorithm>
#include <utility>

#include "solver/numeric/cubic.h"

namespace snapthrough {

Segment::Segment(PointSolver& solver, const PathPoint& from, const PathPoint& to, Measure measure)
    : solver_(solver), from_(&from), to_(&to) {
  const bool by_displacement = measure == Measure::displacement;
  const double length =
      by_displacement ? solver.norm().metric().norm(to.y - from.y, 0.0) : solver.norm().distance(from, to);
  direction_ = std::make_shared<const Direction>(Direction{
      (to.y - from.y) / length, by_displacement ? 0.0 : (to.lambda - from.lambda) / length, by_displacement});
}

Segment::Segment(PointSolver& solver, const PathPoint& from, const PathPoint& to, Eigen::VectorXd direction,
                 double direction_lambda)
    : solver_(solver),
      from_(&from),
      to_(&to),
      direction_(
          std::make_shared<const Direction>(Direction{std::move(direction), direction_lambda, false})) {}

Segment Segment::part(const PathPoint& from, const PathPoint& to) const {
  Segment out = *this;
  out.from_ = &from;
  out.to_ = &to;
  return out;
}

double Segment::length_to(const PathPoint& point) const {
  return solver_.norm().metric().inner(point.y - from_->y, point.lambda - from_->lambda, direction_->y,
                                       direction_->lambda);
}

double Segment::distance() const {
  return solver_.norm().metric().norm(to_->y - from_->y,
                                      direction_->by_displacement ? 0.0 : to_->lambda - from_->lambda);
}

double Segment::cosine(const PathPoint& point) const {
  return solver_.norm().metric().inner(point.tangent, point.tangent_lambda, direction_->y,
                                       direction_->lambda);
}

double Segment::load_rate(const PathPoint& point) const { return point.tangent_lambda / cosine(point); }

void Segment::interpolate(double fraction, PathPoint& point) const {
  constexpr double kLeastCosine = 0.3;  // a smaller one is that of a singular point or of another path
  const double length = this->length();
  const double rate_from = cosine(*from_);
  const double rate_to = cosine(*to_);
  if (rate_from > kLeastCosine && rate_to > kLeastCosine) {
    const CubicWeights h(fraction * length, length);
    point.y =
        h.a * from_->y + (h.da / rate_from) * from_->tangent + h.b * to_->y + (h.db / rate_to) * to_->tangent;
    point.lambda = h.a * from_->lambda + h.da / rate_from * from_->tangent_lambda + h.b * to_->lambda +
                   h.db / rate_to * to_->tangent_lambda;
  } else {
    point.y = (1.0 - fraction) * from_->y + fraction * to_->y;
    point.lambda = (1.0 - fraction) * from_->lambda + fraction * to_->lambda;
  }
}

std::optional<PathPoint> Segment::point_at(double fraction) const {
  PathPoint guess;
  interpolate(fraction, guess);
  auto point = point_near(std::move(guess));
  if (point) point->arc_length = (1.0 - fraction) * from_->arc_length + fraction * to_->arc_length;
  return point;
}

std::optional<PathPoint> Segment::point_near(PathPoint guess) const {
  guess.context = from_->context;
  const double scale =
      std::max(distance(), direction_->by_displacement ? kRoundingResidual : Gradients::tiny);
  const auto outcome =
      solver_.correct_in_plane(direction_->y, direction_->lambda, scale, solver_.options(), guess);
  if (outcome.status != CorrectorStatus::converged) return std::nullopt;
  const bool as_from = outcome.tangent.negative % 2 == from_->negative % 2;
  solver_.set_tangent(guess, outcome, as_from ? from_->negative : to_->negative, direction_->y,
                      direction_->lambda);
  return guess;
}

}  // namespace snapthrough
