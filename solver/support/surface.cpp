#include "solver/support/surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "solver/geometry/cubic_spline.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

double dot(Vec2 a, Vec2 b) { return a[0] * b[0] + a[1] * b[1]; }
double cross(Vec2 a, Vec2 b) { return a[0] * b[1] - a[1] * b[0]; }
Vec2 difference(Vec2 a, Vec2 b) { return {a[0] - b[0], a[1] - b[1]}; }
Vec2 sum(Vec2 a, double share, Vec2 b) { return {a[0] + share * b[0], a[1] + share * b[1]}; }
double length_of(Vec2 a) { return std::hypot(a[0], a[1]); }
/// Unit normal on the left of a unit tangent, times a sense.
Vec2 normal_of(Vec2 tangent, double sense) { return {-sense * tangent[1], sense * tangent[0]}; }

/// Distance of an initial point from a surface; zero where it is the rounding of coordinates.
double settled(double distance) { return std::abs(distance) <= Rounding::coordinate ? 0.0 : distance; }

/// SurfacePoint::size where an initial point has a distance from a surface.
double size_of(double distance, Vec2 x) {
  return settled(distance) == 0.0 ? 0.0 : std::max(std::abs(x[0]), std::abs(x[1]));
}

/// Distance of x + u from a circle, positive outside, with the digits of u. @param from x minus the centre
double beyond_circle(Vec2 from, Vec2 u, double radius) {
  const double before = length_of(from);
  const double after = length_of(sum(from, 1.0, u));
  if (before + after == 0.0) return -radius;
  return settled(before - radius) + dot(u, sum(u, 2.0, from)) / (before + after);
}

class Circle final : public Surface {
 public:
  /// @param sense 1: the medium is outside; -1: inside
  Circle(Vec2 centre, double radius, double sense) : centre_(centre), radius_(radius), sense_(sense) {}
  [[nodiscard]] SurfacePoint at(Vec2 x, Vec2 u) const override {
    const Vec2 from = difference(x, centre_);
    const Vec2 to = sum(from, 1.0, u);
    const double r = length_of(to);
    const double depth = sense_ * beyond_circle(from, u, radius_);
    if (r == 0.0) return {depth, {sense_, 0.0}, 0.0, 0.0};
    return {depth,
            {sense_ * to[0] / r, sense_ * to[1] / r},
            sense_ / r,
            0.0,
            size_of(length_of(from) - radius_, x)};
  }

 private:
  Vec2 centre_;
  double radius_;
  double sense_;
};

class Line final : public Surface {
 public:
  /// @param into unit normal into the medium
  Line(Vec2 through, Vec2 into) : through_(through), into_(into) {}
  [[nodiscard]] SurfacePoint at(Vec2 x, Vec2 u) const override {
    const double before = dot(difference(x, through_), into_);
    return {settled(before) + dot(u, into_), into_, 0.0, 0.0, size_of(before, x)};
  }

 private:
  Vec2 through_;
  Vec2 into_;
};

/// C2 spline through points, continued by straight lines at both ends.
class SplineSurface final : public Surface {
 public:
  /// @param sense 1: the medium is on the left in the order of the points; -1: on the right
  SplineSurface(const std::vector<Vec2>& points, double sense) : sense_(sense) {
    std::array<std::vector<double>, 2> coordinates;
    for (std::size_t i = 0; i < points.size(); ++i) {
      t_.push_back(i == 0 ? 0.0 : t_.back() + length_of(difference(points[i], points[i - 1])));
      for (int c = 0; c < 2; ++c) coordinates[c].push_back(points[i][c]);
    }
    for (int c = 0; c < 2; ++c) spline_[c] = CubicSpline(t_, std::move(coordinates[c]));
    for (std::size_t i = 0; i + 1 < t_.size(); ++i)
      for (int k = 0; k < kStarts; ++k) starts_.push_back(t_[i] + (t_[i + 1] - t_[i]) * k / kStarts);
    starts_.push_back(t_.back());
    for (const double t : starts_) start_points_.push_back(place(t).x);
    for (const double t : t_) {
      const Place p = place(t);
      const double speed = length_of(p.rate);
      seams_.push_back({p.x, {p.rate[0] / speed, p.rate[1] / speed}});
    }
  }

  [[nodiscard]] SurfacePoint at(Vec2 x, Vec2 u) const override {
    SurfacePoint out = of_point(sum(x, 1.0, u));
    const double before = of_point(x).depth;
    if (settled(before) == 0.0) out.depth -= before;
    out.size = size_of(before, x);
    return out;
  }

 private:
  static constexpr int kStarts = 8;  ///< points per interval from which the nearest point is searched for
  static constexpr int kSteps = 60;  ///< steps of that search at most

  [[nodiscard]] SurfacePoint of_point(Vec2 x) const {
    const double t = foot(x);
    const Place p = place(t);
    const double speed = length_of(p.rate);
    const Vec2 into = normal_of({p.rate[0] / speed, p.rate[1] / speed}, sense_);
    const double depth = dot(difference(x, p.x), into);
    if (is_beyond(x, t, p)) return {depth, into, 0.0, 0.0};
    const double curvature = cross(p.rate, p.bend) / (speed * speed * speed);
    const double stretch =
        1.0 - sense_ * curvature * depth;  // ratio of lengths on the parallel curve through x
    const double change = cross(p.rate, third_derivative(t)) / (speed * speed * speed) -
                          3.0 * curvature * dot(p.rate, p.bend) / (speed * speed);
    return {depth, into, -sense_ * curvature / stretch, change / speed / (stretch * stretch * stretch)};
  }

  /// Point of the spline with its derivatives by the parameter.
  struct Place {
    Vec2 x, rate, bend;
  };
  [[nodiscard]] Place place(double t) const {
    const auto x = spline_[0].at(t);
    const auto y = spline_[1].at(t);
    return {{x[0], y[0]}, {x[1], y[1]}, {x[2], y[2]}};
  }
  [[nodiscard]] Vec2 third_derivative(double t) const {
    const auto next = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
    const Vec2 change = difference(place(*next).bend, place(*(next - 1)).bend);
    const double width = *next - *(next - 1);
    return {change[0] / width, change[1] / width};
  }
  /// Whether the nearest point lies on a straight continuation.
  [[nodiscard]] bool is_beyond(Vec2 x, double t, const Place& p) const {
    const double ahead = dot(difference(x, p.x), p.rate);
    return (t == t_.front() && ahead < 0.0) || (t == t_.back() && ahead > 0.0);
  }

  /// Parameter of the point of the spline that is nearest to x.
  [[nodiscard]] double foot(Vec2 x) const {
    const auto square = [&x](Vec2 p) { return dot(difference(x, p), difference(x, p)); };
    const auto nearest =
        static_cast<std::size_t>(std::min_element(start_points_.begin(), start_points_.end(),
                                                  [&](Vec2 a, Vec2 b) { return square(a) < square(b); }) -
                                 start_points_.begin());
    double low = starts_[nearest > 0 ? nearest - 1 : 0];
    double high = starts_[std::min(nearest + 1, starts_.size() - 1)];
    double t = starts_[nearest];
    for (int n = 0; n < kSteps && low < high; ++n) {
      const Place p = place(t);
      const Vec2 away = difference(p.x, x);
      const double slope = dot(away, p.rate);  // half the derivative of the squared distance
      if (slope == 0.0) break;
      (slope > 0.0 ? high : low) = t;
      const double newton = t - slope / (dot(p.rate, p.rate) + dot(away, p.bend));
      const double to = newton > low && newton < high ? newton
                        : slope > 0.0                 ? 0.5 * (low + t)
                                                      : 0.5 * (t + high);
      if (std::abs(to - t) <= 2.0 * std::numeric_limits<double>::epsilon() * t_.back()) break;
      t = to;
    }
    return t;
  }

  double sense_;
  std::vector<double> t_;  ///< chord lengths up to the points
  std::array<CubicSpline, 2> spline_;
  std::vector<double> starts_;
  std::vector<Vec2> start_points_;
};

/// Straight lines through points with rounded corners, continued at both ends.
class RoundedPolyline final : public Surface {
 public:
  /// @param sense see SplineSurface
  RoundedPolyline(const std::vector<Vec2>& points, double radius, double sense) : sense_(sense) {
    Vec2 from = points.front();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec2 tangent = direction(points[i], points[i + 1]);
      Vec2 to = points[i + 1];
      double turn = 0.0;
      Vec2 next{};
      if (i + 2 < points.size()) {
        next = direction(points[i + 1], points[i + 2]);
        turn = std::atan2(cross(tangent, next), dot(tangent, next));
        to = sum(to, -radius * std::tan(0.5 * std::abs(turn)), tangent);
      }
      lines_.push_back({from, tangent, length_of(difference(to, from))});
      if (turn == 0.0) {
        from = to;
        continue;
      }
      const double side = turn > 0.0 ? 1.0 : -1.0;
      arcs_.push_back({sum(to, radius, normal_of(tangent, side)), radius, side, tangent, next});
      from = sum(points[i + 1], radius * std::tan(0.5 * std::abs(turn)), next);
      const double bend = -sense * side / radius;
      seams_.push_back({to, tangent, 0.0, bend});
      seams_.push_back({from, next, bend, 0.0});
    }
  }

  [[nodiscard]] SurfacePoint at(Vec2 x0, Vec2 u) const override {
    const Vec2 x = sum(x0, 1.0, u);
    SurfacePoint best;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](double depth, Vec2 into, double bend, double before) {
      if (!(std::abs(depth) < least)) return;
      least = std::abs(depth);
      best = {depth, into, bend, 0.0, size_of(before, x0)};
    };
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& line = lines_[i];
      const Vec2 away = difference(x, line.from);
      const double along = dot(away, line.tangent);
      // a line overlaps the arcs beside it, so that no point falls between them by rounding
      if ((along >= -Rounding::distance || i == 0) &&
          (along <= line.length + Rounding::distance || i + 1 == lines_.size())) {
        const Vec2 into = normal_of(line.tangent, sense_);
        const double before = dot(difference(x0, line.from), into);
        offer(settled(before) + dot(u, into), into, 0.0, before);
      }
    }
    for (const Arc& arc : arcs_) {
      const Vec2 from = difference(x, arc.centre);
      const double r = length_of(from);
      const Vec2 out{from[0] / r, from[1] / r};
      const Vec2 tangent = normal_of(out, arc.side);
      if (!(r > 0.0) || arc.side * cross(arc.first, tangent) < 0.0 ||
          arc.side * cross(tangent, arc.last) < 0.0)
        continue;
      const double sense = -sense_ * arc.side;  // sense of `into` along `out`
      offer(sense * beyond_circle(difference(x0, arc.centre), u, arc.radius),
            {sense * out[0], sense * out[1]}, sense / r, length_of(difference(x0, arc.centre)) - arc.radius);
    }
    return best;
  }

 private:
  struct Line {
    Vec2 from, tangent;
    double length = 0.0;
  };
  /// Arc that turns by less than half a turn to its left (side 1) or right (-1).
  struct Arc {
    Vec2 centre;
    double radius = 0.0;
    double side = 1.0;
    Vec2 first, last;  ///< tangents at both ends
  };
  static Vec2 direction(Vec2 from, Vec2 to) {
    const Vec2 away = difference(to, from);
    const double size = length_of(away);
    return {away[0] / size, away[1] / size};
  }

  double sense_;
  std::vector<Line> lines_;
  std::vector<Arc> arcs_;
};

/// Makes the surface of each kind of outline, in scaled coordinates.
class Maker {
 public:
  Maker(Vec2 origin, double length) : origin_(origin), length_(length) {}

  std::shared_ptr<const Surface> operator()(const CircleOutline& circle) const {
    return std::make_shared<Circle>(scaled(circle.centre), circle.radius / length_,
                                    circle.medium_inside ? -1.0 : 1.0);
  }
  std::shared_ptr<const Surface> operator()(const LineOutline& line) const {
    const double size = length_of(line.into);
    return std::make_shared<Line>(scaled(line.through), Vec2{line.into[0] / size, line.into[1] / size});
  }
  std::shared_ptr<const Surface> operator()(const SplineOutline& spline) const {
    return std::make_shared<SplineSurface>(scaled(spline.points), sense_of(spline.medium));
  }
  std::shared_ptr<const Surface> operator()(const PolylineOutline& line) const {
    return std::make_shared<RoundedPolyline>(scaled(line.points), line.rounding / length_,
                                             sense_of(line.medium));
  }

 private:
  static double sense_of(Side medium) { return medium == Side::left ? 1.0 : -1.0; }
  [[nodiscard]] Vec2 scaled(Vec2 x) const {
    return {(x[0] - origin_[0]) / length_, (x[1] - origin_[1]) / length_};
  }
  [[nodiscard]] std::vector<Vec2> scaled(const std::vector<Vec2>& points) const {
    std::vector<Vec2> out;
    for (const Vec2& x : points) out.push_back(scaled(x));
    return out;
  }

  Vec2 origin_;
  double length_;
};

}  // namespace

std::shared_ptr<const Surface> make_surface(const Outline& outline, std::array<double, 2> origin,
                                            double length) {
  return std::visit(Maker(origin, length), outline);
}

}  // namespace snapthrough
