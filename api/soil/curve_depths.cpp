#include "api/soil/curve_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "solver/numeric/work_limit.h"

namespace snapthrough::api::soil {

namespace {

/// Largest error that the quarters of an interval may show, so that it is below 1 between them.
constexpr double kSeenError = 0.75;

/// Curves by depth, of which none is computed twice.
class Curves {
 public:
  Curves(const std::function<Curve(double)>& curve_at, double from, double to, const DepthAccuracy& wanted)
      : curve_at_(curve_at), wanted_(wanted) {
    for (const double depth : {from, 0.5 * (from + to), to}) {
      largest_ = std::max(largest_, largest_force(at(depth), wanted.limit));
    }
  }

  const Curve& at(double depth) {
    const auto [found, is_new] = curves_.try_emplace(depth);
    if (is_new) {
      WorkLimit::poll();
      found->second = curve_at_(depth);
    }
    return found->second;
  }

  /// Returns whether interpolation between two depths keeps the accuracy.
  bool fits(double a, double b) {
    if (b <= wanted_.surface) {
      return true;
    }
    return std::ranges::all_of(std::array{0.25, 0.5, 0.75}, [&](double t) {
      const Curve& middle = at(a + t * (b - a));
      const double allowed =
          wanted_.accuracy * std::max(largest_force(middle, wanted_.limit), wanted_.accuracy * largest_);
      return error(at(a), at(b), middle, t) <= kSeenError * allowed;
    });
  }

 private:
  /// Returns the largest difference of (1 - t) a + t b and `middle`, which is at a point of one of them
  /// or at the limit.
  [[nodiscard]] double error(const Curve& a, const Curve& b, const Curve& middle, double t) const {
    const auto error_at = [&](double displacement) {
      const double line = (1.0 - t) * force_at(a, displacement) + t * force_at(b, displacement);
      return std::abs(line - force_at(middle, displacement));
    };
    double largest = error_at(wanted_.limit);
    for (const Curve* curve : {&a, &b, &middle}) {
      for (const auto& [displacement, force] : curve->points) {
        if (displacement <= wanted_.limit) {
          largest = std::max(largest, error_at(displacement));
        }
      }
    }
    return largest;
  }

  const std::function<Curve(double)>& curve_at_;
  DepthAccuracy wanted_;
  double largest_ = 0.0;
  std::map<double, Curve> curves_;
};

}  // namespace

double force_at(const Curve& curve, double displacement) {
  const auto& points = curve.points;
  const auto after = std::upper_bound(points.begin(), points.end(), displacement,
                                      [](double value, const auto& point) { return value < point[0]; });
  if (after == points.end()) {
    return points.empty() ? 0.0 : points.back()[1];
  }
  if (after == points.begin()) {
    return (*after)[1];
  }
  const auto& [x0, y0] = *(after - 1);
  const auto& [x1, y1] = *after;
  return y0 + (y1 - y0) * (displacement - x0) / (x1 - x0);
}

double largest_force(const Curve& curve, double limit) {
  double largest = force_at(curve, limit);
  for (const auto& [displacement, force] : curve.points) {
    if (displacement <= limit) {
      largest = std::max(largest, force);
    }
  }
  return largest;
}

std::optional<std::vector<CurveAtDepth>> curves_by_depth(const std::function<Curve(double)>& curve_at,
                                                         double from, double to,
                                                         const DepthAccuracy& wanted) {
  Curves curves(curve_at, from, to, wanted);
  std::vector<double> ends{to};  // ends of the intervals below `above`, the deepest first
  std::vector<double> depths{from};
  while (!ends.empty()) {
    const double above = depths.back();
    const double below = ends.back();
    if (curves.fits(above, below)) {
      depths.push_back(below);
      ends.pop_back();
    } else if (below - above < 2.0 * wanted.shortest || depths.size() + ends.size() >= kMaxBreakPoints) {
      return std::nullopt;
    } else {
      ends.push_back(0.5 * (above + below));
    }
  }
  std::vector<CurveAtDepth> out;
  for (const double depth : depths) {
    out.push_back({depth, curves.at(depth)});
  }
  return out;
}

}  // namespace snapthrough::api::soil
