#include "solver/sensitivity/offset_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "solver/numeric/dense.h"
#include "solver/numeric/gauss_rule.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kIntervals = OffsetSpace::kPoints + 1;

/// Step length and bounds of the interior-point method that solves the linear program of a worst
/// imperfection. Source of the step: Vanderbei, Meketon and Freedman, Algorithmica 1, 1986.
struct ProgramLimits {
  static constexpr int samples = 8;           ///< points per interval at which |w| is bounded
  static constexpr double share = 2.0 / 3.0;  ///< step over the distance to the boundary; proven to converge
  static constexpr double settled = 1e-9;     ///< relative gain of a step at the end
  static constexpr int steps = 200;           ///< steps at most; each divides the gap by about three
};

/// Spline over the fraction of a member through `values`, zero at the ends.
CubicSpline spline_through(const VectorXd& values) {
  std::vector<double> t(kIntervals + 1);
  std::vector<double> w(kIntervals + 1, 0.0);
  for (int i = 0; i <= kIntervals; ++i) t[static_cast<std::size_t>(i)] = static_cast<double>(i) / kIntervals;
  std::copy(values.begin(), values.end(), w.begin() + 1);
  return {std::move(t), std::move(w)};
}

/// Values of the cardinal splines at fractions: one row per fraction.
MatrixXd cardinal_values(const std::vector<double>& fractions) {
  MatrixXd out(static_cast<Index>(fractions.size()), OffsetSpace::kPoints);
  for (Index j = 0; j < out.cols(); ++j) {
    const CubicSpline spline = spline_through(VectorXd::Unit(OffsetSpace::kPoints, j));
    for (Index i = 0; i < out.rows(); ++i) out(i, j) = spline.at(fractions[static_cast<std::size_t>(i)])[0];
  }
  return out;
}

/// Largest |w| of a spline on [0, 1]: each of its cubic pieces has its extremes at the roots of a quadratic.
double largest_of(const CubicSpline& spline) {
  double largest = 0.0;
  for (int i = 0; i < kIntervals; ++i) {
    const double h = 1.0 / kIntervals;
    const double from = i * h;
    const auto left = spline.at(from);
    const auto right = spline.at(from + h);
    largest = std::max({largest, std::abs(left[0]), std::abs(right[0])});
    // w' = a x^2 + b x + c on the piece
    const double a = (right[2] - left[2]) / (2.0 * h);
    const double b = left[2];
    const double c = left[1];
    const double root = b * b - 4.0 * a * c;
    if (root < 0.0) continue;
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    for (const double x : {q / a, c / q})
      if (x > 0.0 && x < h) largest = std::max(largest, std::abs(spline.at(from + x)[0]));
  }
  return largest;
}

}  // namespace

OffsetSpace::OffsetSpace(std::vector<double> lengths)
    : lengths_(std::move(lengths)),
      length_(std::accumulate(lengths_.begin(), lengths_.end(), 0.0)),
      gram_(MatrixXd::Zero(kPoints, kPoints)) {
  const Quadrature rule = gauss_legendre(4);  // exact for products of two cubics
  std::vector<double> places;
  std::vector<double> at_samples;
  for (int i = 0; i < kIntervals; ++i) {
    for (const double x : rule.points) places.push_back((i + x) / kIntervals);
    for (int k = 0; k < ProgramLimits::samples; ++k)
      at_samples.push_back((i + static_cast<double>(k) / ProgramLimits::samples) / kIntervals);
  }
  const MatrixXd values = cardinal_values(places);
  for (Index i = 0; i < values.rows(); ++i) {
    const double weight = rule.weights[static_cast<std::size_t>(i) % rule.weights.size()] / kIntervals;
    gram_ += weight * values.row(i).transpose() * values.row(i);
  }
  samples_ = cardinal_values(at_samples);
}

double OffsetSpace::norm(OffsetNorm norm, const VectorXd& offsets) const {
  double sum = 0.0;
  double largest = 0.0;
  for (std::size_t m = 0; m < lengths_.size(); ++m) {
    const VectorXd own = offsets.segment(static_cast<Index>(m) * kPoints, kPoints);
    if (norm == OffsetNorm::max)
      largest = std::max(largest, largest_of(spline_through(own)));
    else
      sum += lengths_[m] / length_ * own.dot(gram_ * own);
  }
  return norm == OffsetNorm::max ? largest : std::sqrt(sum);
}

/// Coefficients on one member that maximise gradient . c with |w| <= 1.
VectorXd OffsetSpace::steepest_within_one(const VectorXd& gradient) const {
  VectorXd c = VectorXd::Zero(kPoints);
  const Eigen::ArrayXd ones = Eigen::ArrayXd::Ones(samples_.rows());
  for (int step = 0; step < ProgramLimits::steps; ++step) {
    const Eigen::ArrayXd w = samples_ * c;
    const VectorXd weights = (ones - w).square().inverse() + (ones + w).square().inverse();
    const VectorXd way = solve_row_pivoting(samples_.transpose() * weights.asDiagonal() * samples_, gradient);
    const Eigen::ArrayXd rate = samples_ * way;
    const Eigen::ArrayXd left = (rate > 0.0).select(ones - w, ones + w) / rate.abs();
    const double reach = left.isNaN().select(std::numeric_limits<double>::infinity(), left).minCoeff();
    if (!std::isfinite(reach)) break;
    c += ProgramLimits::share * reach * way;
    if (ProgramLimits::share * reach * gradient.dot(way) <= ProgramLimits::settled * gradient.dot(c)) break;
  }
  const double largest = largest_of(spline_through(c));
  return largest > 0.0 ? VectorXd(c / largest) : c;
}

VectorXd OffsetSpace::steepest(OffsetNorm norm, const VectorXd& gradient) const {
  VectorXd out = VectorXd::Zero(size());
  const double largest = gradient.lpNorm<Eigen::Infinity>();
  if (!(largest > 0.0)) return out;
  for (std::size_t m = 0; m < lengths_.size(); ++m) {
    const Index first = static_cast<Index>(m) * kPoints;
    const VectorXd own = gradient.segment(first, kPoints) / largest;
    if (norm == OffsetNorm::rms)
      out.segment(first, kPoints) = solve_row_pivoting(gram_, own) / lengths_[m];
    else if (own.lpNorm<Eigen::Infinity>() > std::sqrt(std::numeric_limits<double>::epsilon()))
      out.segment(first, kPoints) = steepest_within_one(own);  // a smaller gradient is rounding
  }
  return out / this->norm(norm, out);
}

std::vector<MemberOffsets> OffsetSpace::member_offsets(const ResolvedModel& model,
                                                       const VectorXd& offsets) const {
  std::vector<MemberOffsets> out;
  for (std::size_t m = 0; m < lengths_.size(); ++m) {
    const VectorXd own = offsets.segment(static_cast<Index>(m) * kPoints, kPoints);
    MemberOffsets member{model.members[m].id, {{0.0, 0.0}}};
    for (int i = 0; i < kPoints; ++i) member.offsets.push_back({(i + 1.0) / kIntervals, own[i]});
    member.offsets.push_back({1.0, 0.0});
    out.push_back(std::move(member));
  }
  return out;
}

}  // namespace snapthrough
