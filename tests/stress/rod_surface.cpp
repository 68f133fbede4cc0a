#include "tests/stress/rod_surface.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

namespace snapthrough::testing {
namespace {

using Eigen::Vector2d;

Vector2d left_of(const Vector2d& t) { return {-t.y(), t.x()}; }
double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Point of a curve with the unit tangent and the curvature, positive to the left.
struct CurvePoint {
  Vector2d x, tangent;
  double curvature = 0.0;
};

/// Depth of a point by the nearest point of a curve. On the parallel curve at the distance d to the left the
/// curvature is k / (1 - k d).
/// @param side 1: the medium is on the left; -1: on the right
RodDepth depth_below(const CurvePoint& nearest, const Vector2d& x, double side) {
  const Vector2d normal = left_of(nearest.tangent);
  const double left = normal.dot(x - nearest.x);
  return {side * left, side * normal, -side * nearest.curvature / (1.0 - nearest.curvature * left)};
}

class RodCircle final : public RodSurface {
 public:
  RodCircle(Vector2d centre, double radius, bool inside)
      : centre_(std::move(centre)), radius_(radius), sense_(inside ? -1.0 : 1.0) {}
  [[nodiscard]] RodDepth at(const Vector2d& x) const override {
    const Vector2d from = x - centre_;
    const double r = from.norm();
    return {sense_ * (r - radius_), sense_ / r * from, sense_ / r};
  }

 private:
  Vector2d centre_;
  double radius_, sense_;
};

class RodLine final : public RodSurface {
 public:
  RodLine(Vector2d through, const Vector2d& into) : through_(std::move(through)), into_(into.normalized()) {}
  [[nodiscard]] RodDepth at(const Vector2d& x) const override {
    return {into_.dot(x - through_), into_, 0.0};
  }

 private:
  Vector2d through_, into_;
};

/// Straight sides and arcs, in the order of the points.
class RodPolyline final : public RodSurface {
 public:
  RodPolyline(const std::vector<Vector2d>& points, double radius, double side) : side_(side) {
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    Vector2d start = points[0];
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Vector2d t = (points[i] - points[i - 1]).normalized();
      const double from = i == 1 ? -kEndless : 0.0;
      if (i + 1 == points.size()) {
        pieces_.push_back({start, t, start, 0.0, from, kEndless});
        continue;
      }
      const Vector2d next = (points[i + 1] - points[i]).normalized();
      const double turn = std::atan2(cross(t, next), t.dot(next));
      const double cut = radius * std::tan(0.5 * std::abs(turn));
      const Vector2d end = points[i] - cut * t;
      pieces_.push_back({start, t, end, 0.0, from, (end - start).dot(t)});
      start = points[i] + cut * next;
      if (turn != 0.0) pieces_.push_back({end, t, start, std::copysign(1.0 / radius, turn), 0.0, 0.0});
    }
  }
  [[nodiscard]] RodDepth at(const Vector2d& x) const override {
    CurvePoint best;
    double least = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces_) {
      const CurvePoint foot = nearest_on(piece, x);
      const double away = (x - foot.x).norm();
      if (away < least) {
        least = away;
        best = foot;
      }
    }
    return depth_below(best, x, side_);
  }

 private:
  struct Piece {
    Vector2d start, tangent, end;
    double curvature = 0.0;
    double from = 0.0, to = 0.0;  ///< of a straight side: lengths from `start` along the tangent
  };
  static CurvePoint nearest_on(const Piece& piece, const Vector2d& x) {
    if (piece.curvature == 0.0) {
      const double along = std::clamp(piece.tangent.dot(x - piece.start), piece.from, piece.to);
      return {piece.start + along * piece.tangent, piece.tangent, 0.0};
    }
    const double radius = 1.0 / std::abs(piece.curvature);
    const double turn = std::copysign(1.0, piece.curvature);
    const Vector2d centre = piece.start + turn * radius * left_of(piece.tangent);
    const auto angle_to = [&](const Vector2d& to) {
      const Vector2d from = piece.start - centre;
      return turn * std::atan2(cross(from, to - centre), from.dot(to - centre));
    };
    const double angle = turn * std::clamp(angle_to(x), 0.0, angle_to(piece.end));
    const Vector2d out = Eigen::Rotation2Dd(angle) * Vector2d(piece.start - centre);
    return {centre + out, Eigen::Rotation2Dd(angle) * piece.tangent, piece.curvature};
  }

  double side_;
  std::vector<Piece> pieces_;
};

/// Cubic spline over the chord lengths whose third derivative is continuous at the second and the last but
/// one point, with straight ends. Three points have a parabola, two a line.
class RodSpline final : public RodSurface {
 public:
  RodSpline(const std::vector<Vector2d>& points, double side) : side_(side) {
    const auto n = static_cast<Eigen::Index>(points.size());
    t_.resize(n);
    x_.resize(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
      x_.row(i) = points[static_cast<std::size_t>(i)].transpose();
      t_[i] = i == 0 ? 0.0 : t_[i - 1] + (x_.row(i) - x_.row(i - 1)).norm();
    }
    // unknown: second derivatives at the points
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n, 2);
    const auto width = [this](Eigen::Index i) { return t_[i + 1] - t_[i]; };
    for (Eigen::Index i = 1; i + 1 < n; ++i) {
      A.row(i).segment<3>(i - 1) << width(i - 1), 2.0 * (width(i - 1) + width(i)), width(i);
      b.row(i) = 6.0 * ((x_.row(i + 1) - x_.row(i)) / width(i) - (x_.row(i) - x_.row(i - 1)) / width(i - 1));
    }
    A(0, 0) = A(n - 1, n - 1) = 1.0;
    if (n == 3) A(0, 1) = A(2, 1) = -1.0;
    if (n > 3) {
      A.row(0).head<3>() << width(1), -width(0) - width(1), width(0);
      A.row(n - 1).tail<3>() << width(n - 2), -width(n - 3) - width(n - 2), width(n - 3);
    }
    second_ = A.fullPivLu().solve(b);
  }

  [[nodiscard]] RodDepth at(const Vector2d& x) const override {
    constexpr int kSamples = 50;  // of an interval
    double best = t_[0];
    double least = std::numeric_limits<double>::infinity();
    double step = 0.0;
    for (Eigen::Index i = 0; i + 1 < t_.size(); ++i)
      for (int k = 0; k <= kSamples; ++k) {
        const double t = t_[i] + (t_[i + 1] - t_[i]) * k / kSamples;
        const double away = (jet(t).x - x).norm();
        if (away >= least) continue;
        least = away;
        best = t;
        step = (t_[i + 1] - t_[i]) / kSamples;
      }
    // the distance has its minimum where the curve's tangent is across
    const auto ahead = [&](double t) { return (x - jet(t).x).dot(jet(t).rate); };
    double low = std::max(best - 2.0 * step, 0.0);
    double high = std::min(best + 2.0 * step, t_[t_.size() - 1]);
    for (int n = 0; n < 80; ++n) {
      const double t = 0.5 * (low + high);
      (ahead(t) > 0.0 ? low : high) = t;
    }
    const Jet foot = jet(0.5 * (low + high));
    const double speed = foot.rate.norm();
    const double beyond = foot.rate.dot(x - foot.x) / speed;
    if (std::abs(beyond) > 1e-9 * t_[t_.size() - 1])  // on a straight end
      return depth_below({foot.x + beyond / speed * foot.rate, foot.rate / speed, 0.0}, x, side_);
    return depth_below({foot.x, foot.rate / speed, cross(foot.rate, foot.bend) / std::pow(speed, 3)}, x,
                       side_);
  }

 private:
  struct Jet {
    Vector2d x, rate, bend;
  };
  [[nodiscard]] Jet jet(double t) const {
    Eigen::Index i = 0;
    while (i + 2 < t_.size() && t >= t_[i + 1]) ++i;
    const double h = t_[i + 1] - t_[i];
    const double right = (t - t_[i]) / h;
    const double left = 1.0 - right;
    const Vector2d a = second_.row(i);
    const Vector2d b = second_.row(i + 1);
    const Vector2d from = x_.row(i);
    const Vector2d to = x_.row(i + 1);
    return {left * from + right * to +
                h * h / 6.0 * ((left * left * left - left) * a + (right * right * right - right) * b),
            (to - from) / h + h / 6.0 * ((1.0 - 3.0 * left * left) * a + (3.0 * right * right - 1.0) * b),
            left * a + right * b};
  }

  double side_;
  Eigen::VectorXd t_;
  Eigen::MatrixXd x_, second_;
};

}  // namespace

std::shared_ptr<const RodSurface> surface_of(const Outline& outline, const std::array<double, 2>& origin,
                                             double length) {
  const auto scaled = [&](const std::array<double, 2>& x) {
    return Vector2d((x[0] - origin[0]) / length, (x[1] - origin[1]) / length);
  };
  const auto all = [&](const std::vector<std::array<double, 2>>& points) {
    std::vector<Vector2d> out;
    for (const auto& x : points) out.push_back(scaled(x));
    return out;
  };
  const auto sense = [](Side medium) { return medium == Side::left ? 1.0 : -1.0; };
  if (const auto* c = std::get_if<CircleOutline>(&outline))
    return std::make_shared<RodCircle>(scaled(c->centre), c->radius / length, c->medium_inside);
  if (const auto* l = std::get_if<LineOutline>(&outline))
    return std::make_shared<RodLine>(scaled(l->through), Vector2d(l->into[0], l->into[1]));
  if (const auto* p = std::get_if<PolylineOutline>(&outline))
    return std::make_shared<RodPolyline>(all(p->points), p->rounding / length, sense(p->medium));
  const auto& s = std::get<SplineOutline>(outline);
  return std::make_shared<RodSpline>(all(s.points), sense(s.medium));
}

}  // namespace snapthrough::testing
