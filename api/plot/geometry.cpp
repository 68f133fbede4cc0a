#include "api/plot/geometry.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "api/plot/ink.h"

namespace snapthrough::api::plot {
namespace {

using Curve = std::function<Point(double)>;  // returns the point at a parameter from 0 to 1

constexpr double kDegree = std::numbers::pi / 180;

struct Drawn {
  Curve curve;
  std::size_t intervals;
};

/// Returns the curve with the given offset to the left of the chord.
Curve over_chord(Point start, Point end, std::function<double(double)> offset) {
  const double dx = end.x - start.x;
  const double dy = end.y - start.y;
  const double chord = std::hypot(dx, dy);
  return [=, offset = std::move(offset)](double t) {
    const double height = offset(t) / chord;
    return Point{start.x + t * dx - height * dy, start.y + t * dy + height * dx};
  };
}

/// Returns the curve whose offset from the chord is along a direction.
Curve parabola(double rise, const std::vector<double>& direction, Point start, Point end) {
  const double size = std::hypot(direction[0], direction[1]);
  const double ux = size > 0 ? direction[0] / size : 0;
  const double uy = size > 0 ? direction[1] / size : 0;
  return [=](double t) {
    const double offset = 4 * rise * t * (1 - t);
    return Point{start.x + t * (end.x - start.x) + offset * ux,
                 start.y + t * (end.y - start.y) + offset * uy};
  };
}

Curve arc(double sweep, Point start, Point end) {
  const double chord = std::hypot(end.x - start.x, end.y - start.y);
  const double direction = std::atan2(end.y - start.y, end.x - start.x);
  const double radius = chord / (2 * std::sin(sweep / 2));  // radius < 0 for a negative sweep
  const double angle = direction - sweep / 2;
  return [=](double t) {
    return Point{start.x + radius * (std::sin(angle + t * sweep) - std::sin(angle)),
                 start.y - radius * (std::cos(angle + t * sweep) - std::cos(angle))};
  };
}

/// Returns the second derivatives at the points (t, f) of the not-a-knot cubic spline. Thomas' algorithm
/// solves for the inner points, with the end values eliminated.
std::vector<double> spline_bends(const std::vector<double>& t, const std::vector<double>& f) {
  const std::size_t n = t.size();
  const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto slope = [&](std::size_t i) { return (f[i + 1] - f[i]) / h(i); };
  std::vector<double> bends(n, 0);
  if (n < 3) {
    return bends;
  }
  if (n == 3) {
    return std::vector<double>(3, 2 * (slope(1) - slope(0)) / (h(0) + h(1)));
  }
  const double left = h(0) / h(1);
  const double right = h(n - 2) / h(n - 3);
  std::vector<double> diagonal(n, 0);
  std::vector<double> upper(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const bool first = i == 1;
    const bool final = i == n - 2;
    const double lower = first ? 0 : h(i - 1) - (final ? right * h(i) : 0);
    diagonal[i] = 2 * (h(i - 1) + h(i)) + (first ? (1 + left) * h(0) : 0) + (final ? (1 + right) * h(i) : 0);
    upper[i] = final ? 0 : h(i) - (first ? left * h(0) : 0);
    bends[i] = 6 * (slope(i) - slope(i - 1));
    if (!first) {
      const double factor = lower / diagonal[i - 1];
      diagonal[i] -= factor * upper[i - 1];
      bends[i] -= factor * bends[i - 1];
    }
  }
  for (std::size_t i = n - 2; i >= 1; --i) {
    bends[i] = (bends[i] - (i + 2 < n ? upper[i] * bends[i + 1] : 0)) / diagonal[i];
  }
  bends[0] = (1 + left) * bends[1] - left * bends[2];
  bends[n - 1] = (1 + right) * bends[n - 2] - right * bends[n - 3];
  return bends;
}

std::function<double(double)> spline(const std::vector<double>& t, const std::vector<double>& f) {
  return [t, f, m = spline_bends(t, f)](double where) {
    const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, where);
    const auto i = static_cast<std::size_t>(after - t.begin()) - 1;
    const double h = t[i + 1] - t[i];
    const double a = (t[i + 1] - where) / h;
    const double b = (where - t[i]) / h;
    return a * f[i] + b * f[i + 1] + ((a * a * a - a) * m[i] + (b * b * b - b) * m[i + 1]) * h * h / 6;
  };
}

Drawn through_points(const Field& points, Point start, Point end) {
  constexpr std::size_t kEach = 24;
  constexpr std::size_t kMost = 8000;
  std::vector<double> x{start.x};
  std::vector<double> y{start.y};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<double> point = points.item(i).numbers(2);
    x.push_back(point[0]);
    y.push_back(point[1]);
  }
  x.push_back(end.x);
  y.push_back(end.y);
  std::vector<double> t{0};
  for (std::size_t i = 1; i < x.size(); ++i) {
    t.push_back(t.back() + std::hypot(x[i] - x[i - 1], y[i] - y[i - 1]));
    if (t[i] == t[i - 1]) {
      points.fail("must have no two points at one place");
    }
  }
  const double whole = t.back();
  return {[fx = spline(t, x), fy = spline(t, y), whole](double where) {
            return Point{fx(where * whole), fy(where * whole)};
          },
          std::min(kMost, kEach * (points.size() + 1))};
}

Drawn curve_of(const std::optional<Field>& field, Point start, Point end) {
  const std::string type = field ? field->at("type").text() : "line";
  if (type == "line") {
    return {over_chord(start, end, [](double) { return 0.0; }), 1};
  }
  if (type == "parabola") {
    const double rise = field->at("rise").number();
    if (const std::optional<Field> direction = field->find("direction")) {
      return {parabola(rise, direction->numbers(2), start, end), 64};
    }
    return {over_chord(start, end, [rise](double t) { return 4 * rise * t * (1 - t); }), 64};
  }
  if (type == "sine") {
    const double rise = field->at("rise").number();
    const double waves = std::min(1000.0, number_or(*field, "half_waves", 1));
    return {over_chord(start, end, [=](double t) { return rise * std::sin(waves * std::numbers::pi * t); }),
            static_cast<std::size_t>(std::clamp(48 * waves, 48.0, 4000.0))};
  }
  if (type == "arc") {
    const double sweep = field->at("sweep_degrees").number();
    if (!(std::abs(sweep) > 0 && std::abs(sweep) < 360)) {
      field->at("sweep_degrees").fail("must be between -360 and 360, and not 0");
    }
    return {arc(sweep * kDegree, start, end),
            static_cast<std::size_t>(std::max(32.0, std::ceil(std::abs(sweep) / 2)))};
  }
  if (type == "points") {
    return through_points(field->at("points"), start, end);
  }
  field->at("type").fail("is a type of curve that no figure knows");
}

/// Returns a one-sided difference at an end, proportional to the slope; second order from three values on.
double end_slope(const std::vector<double>& values, std::size_t end) {
  const std::size_t n = values.size();
  if (end == 0) {
    return n < 3 ? values[1] - values[0] : 4 * values[1] - 3 * values[0] - values[2];
  }
  return n < 3 ? values[end] - values[end - 1] : 3 * values[end] + values[end - 2] - 4 * values[end - 1];
}

}  // namespace

double interpolate(const std::vector<double>& s, const std::vector<double>& values, double where) {
  if (where <= s.front()) {
    return values.front();
  }
  const auto after = std::upper_bound(s.begin(), s.end(), where);
  if (after == s.end()) {
    return values.back();
  }
  const auto i = static_cast<std::size_t>(after - s.begin());
  return values[i - 1] + (where - s[i - 1]) / (s[i] - s[i - 1]) * (values[i] - values[i - 1]);
}

std::vector<Point> left_normals(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Point> normals;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool end = i == 0 || i + 1 == x.size();
    const double dx = end ? end_slope(x, i) : x[i + 1] - x[i - 1];
    const double dy = end ? end_slope(y, i) : y[i + 1] - y[i - 1];
    const double length = std::hypot(dx, dy);
    normals.push_back(length > 0 ? Point{-dy / length, dx / length} : Point{0, 1});
  }
  return normals;
}

Axis member_axis(const Field& member, const std::optional<Field>& curve, Point start, Point end) {
  if (start.x == end.x && start.y == end.y) {
    member.fail("has no length: its nodes are at one place");
  }
  const auto [along, intervals] = curve_of(curve, start, end);
  Ink::spend(2 * (intervals + 1));
  Axis axis;
  for (std::size_t i = 0; i <= intervals; ++i) {
    const Point point = along(static_cast<double>(i) / static_cast<double>(intervals));
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      member.fail("has an axis that is not finite");
    }
    axis.s.push_back(i == 0 ? 0
                            : axis.s.back() + std::hypot(point.x - axis.x.back(), point.y - axis.y.back()));
    axis.x.push_back(point.x);
    axis.y.push_back(point.y);
  }
  return axis;
}

}  // namespace snapthrough::api::plot
