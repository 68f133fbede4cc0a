#include "solver/numeric/piecewise_cubic.h"

#include <algorithm>
#include <utility>

namespace snapthrough {

std::vector<double> cubic_slopes(const CurvePoints& points) {
  const std::size_t n = points.size();
  std::vector<double> out(n, 0.0);
  const auto width = [&](std::size_t i) { return points[i + 1][0] - points[i][0]; };
  const auto chord = [&](std::size_t i) { return (points[i + 1][1] - points[i][1]) / width(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = chord(i - 1);
    const double after = chord(i);
    const bool has_one_sense = (before > 0.0 && after > 0.0) || (before < 0.0 && after < 0.0);
    if (!has_one_sense) continue;
    const double a = width(i) + 2.0 * width(i - 1);
    const double b = 2.0 * width(i) + width(i - 1);
    out[i] = (a + b) / (b / before + a / after);
  }
  if (n == 2) return {chord(0), chord(0)};
  out.front() = 0.5 * (3.0 * chord(0) - out[1]);
  out.back() = 0.5 * (3.0 * chord(n - 2) - out[n - 2]);
  return out;
}

CurvePoints with_origin(CurvePoints points) {
  if (points.empty() || points.front()[0] > 0.0) points.insert(points.begin(), {0.0, 0.0});
  return points;
}

PiecewiseCubic::PiecewiseCubic(CurvePoints points, const std::vector<double>& slopes)
    : points_(std::move(points)), slope_changes_(points_.size(), 0.0) {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const double h = points_[i + 1][0] - points_[i][0];
    const double chord = (points_[i + 1][1] - points_[i][1]) / h;
    const double a = slopes.empty() ? chord : slopes[i];
    const double b = slopes.empty() ? chord : slopes[i + 1];
    if (i > 0) slope_changes_[i] = a - last_slope_;
    last_slope_ = b;
    pieces_.push_back(
        {points_[i][0], points_[i][1], a, (3.0 * chord - 2.0 * a - b) / h, (a + b - 2.0 * chord) / (h * h)});
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i > 0) sum += integral(pieces_[i - 1], points_[i][0]);
    integrals_.push_back(sum);
  }
}

PiecewiseCubic::Values PiecewiseCubic::at(double x) const {
  const Piece& piece = pieces_[piece_at(x)];
  const double t = x - piece.from;
  return {piece.value + t * (piece.slope + t * (piece.second + t * piece.third)),
          piece.slope + t * (2.0 * piece.second + 3.0 * t * piece.third),
          2.0 * piece.second + 6.0 * t * piece.third};
}

double PiecewiseCubic::integral_to(double x) const {
  const std::size_t i = piece_at(x);
  return integrals_[i] + integral(pieces_[i], x);
}

std::size_t PiecewiseCubic::piece_at(double x) const {
  const auto next = std::upper_bound(points_.begin(), points_.end(), x,
                                     [](double value, const auto& point) { return value < point[0]; });
  return static_cast<std::size_t>(next - points_.begin()) - 1;
}

double PiecewiseCubic::integral(const Piece& p, double to) {
  const double t = to - p.from;
  return t * (p.value + t * (p.slope / 2.0 + t * (p.second / 3.0 + t * p.third / 4.0)));
}

}  // namespace snapthrough
