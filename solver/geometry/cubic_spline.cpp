#include "solver/geometry/cubic_spline.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace snapthrough {
namespace {

/// Second derivatives of the not-a-knot spline: continuity of slopes at interior points, and the third
/// derivative continuous across the first and the last interior point.
std::vector<double> not_a_knot(const std::vector<double>& t, const std::vector<double>& f) {
  const auto n = static_cast<int>(t.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n);
  for (int i = 1; i + 1 < n; ++i) {
    const double h0 = t[i] - t[i - 1];
    const double h1 = t[i + 1] - t[i];
    entries.emplace_back(i, i - 1, h0 / 6.0);
    entries.emplace_back(i, i, (h0 + h1) / 3.0);
    entries.emplace_back(i, i + 1, h1 / 6.0);
    rhs(i) = (f[i + 1] - f[i]) / h1 - (f[i] - f[i - 1]) / h0;
  }
  const auto third_derivative_row = [&entries, &t](int row, int i) {
    const double h0 = t[i] - t[i - 1];
    const double h1 = t[i + 1] - t[i];
    entries.emplace_back(row, i - 1, -h1);  // times h0 h1: no row is much larger than the others
    entries.emplace_back(row, i, h0 + h1);
    entries.emplace_back(row, i + 1, -h0);
  };
  third_derivative_row(0, 1);
  third_derivative_row(n - 1, n - 2);
  Eigen::SparseMatrix<double> a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(a);
  if (lu.info() != Eigen::Success) {
    throw std::invalid_argument("the points of a spline are too near to each other");
  }
  const Eigen::VectorXd m = lu.solve(rhs);
  return {m.data(), m.data() + n};
}

}  // namespace

CubicSpline::CubicSpline(std::vector<double> t, std::vector<double> f) : t_(std::move(t)), f_(std::move(f)) {
  m_.assign(t_.size(), 0.0);
  if (t_.size() == 3) {
    const double s0 = (f_[1] - f_[0]) / (t_[1] - t_[0]);
    const double s1 = (f_[2] - f_[1]) / (t_[2] - t_[1]);
    m_.assign(3, 2.0 * (s1 - s0) / (t_[2] - t_[0]));
  } else if (t_.size() > 3) {
    m_ = not_a_knot(t_, f_);
  }
}

std::array<double, 3> CubicSpline::at(double t) const {
  const auto upper = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
  const auto i = static_cast<std::size_t>(upper - t_.begin()) - 1;
  const double h = t_[i + 1] - t_[i];
  const double a = (t_[i + 1] - t) / h;
  const double b = (t - t_[i]) / h;
  const double value =
      a * f_[i] + b * f_[i + 1] + ((a * a * a - a) * m_[i] + (b * b * b - b) * m_[i + 1]) * h * h / 6.0;
  const double slope =
      (f_[i + 1] - f_[i]) / h + (-(3.0 * a * a - 1.0) * m_[i] + (3.0 * b * b - 1.0) * m_[i + 1]) * h / 6.0;
  return {value, slope, a * m_[i] + b * m_[i + 1]};
}

}  // namespace snapthrough
