#include "solver/linalg/symmetric_indefinite.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace snapthrough {

using Eigen::Index;

void SymmetricIndefinite::swap_rows(Index a, Index b, Index done) {
  if (a == b) return;
  // symmetric exchange of rows and columns a < b, lower triangle; columns before `done` hold factors in the
  // order of their own time, and solve() exchanges at the same moments
  for (Index j = done; j < a; ++j) std::swap(l_(a, j), l_(b, j));
  for (Index j = a + 1; j < b; ++j) std::swap(l_(j, a), l_(b, j));
  for (Index j = b + 1; j < l_.rows(); ++j) std::swap(l_(j, a), l_(j, b));
  std::swap(l_(a, a), l_(b, b));
}

void SymmetricIndefinite::note_pivot(double eigenvalue) {
  const double size = std::abs(eigenvalue);
  if (size <= floor_) ++inertia_.zero;
  if (eigenvalue < 0.0) ++inertia_.negative;
  smallest_ = std::min(smallest_, size);
  largest_ = std::max(largest_, size);
  log_abs_det_ += std::log(std::max(size, std::numeric_limits<double>::min()));
}

Index SymmetricIndefinite::eliminate_one(Index k) {
  const Index n = l_.rows();
  if (l_(k, k) == 0.0) l_(k, k) = std::max(floor_, std::numeric_limits<double>::min()) * 1e-3;
  const double d = l_(k, k);
  note_pivot(d);
  for (Index j = k + 1; j < n; ++j) {
    const double f = l_(j, k) / d;
    for (Index i = j; i < n; ++i) l_(i, j) -= l_(i, k) * f;
  }
  for (Index i = k + 1; i < n; ++i) l_(i, k) /= d;
  return k + 1;
}

Index SymmetricIndefinite::eliminate_two(Index k) {
  const Index n = l_.rows();
  const double a = l_(k, k);
  const double b = l_(k + 1, k);
  const double c = l_(k + 1, k + 1);
  const double det = a * c - b * b;
  const double mean = 0.5 * (a + c);
  const double radius = std::hypot(0.5 * (a - c), b);
  const double far = mean >= 0.0 ? mean + radius : mean - radius;
  note_pivot(far);
  note_pivot(det / far);
  for (Index j = k + 2; j < n; ++j) {
    const double f0 = (c * l_(j, k) - b * l_(j, k + 1)) / det;
    const double f1 = (a * l_(j, k + 1) - b * l_(j, k)) / det;
    for (Index i = j; i < n; ++i) l_(i, j) -= l_(i, k) * f0 + l_(i, k + 1) * f1;
    l_(j, k) = f0;
    l_(j, k + 1) = f1;
  }
  two_[k] = 1;
  return k + 2;
}

/// Solutions with a matrix that is not finite are not finite either: pivots could not be chosen.
void SymmetricIndefinite::refuse() {
  l_.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (Index k = 0; k < l_.rows(); ++k) swap_[2 * k] = k;
  pivot_ratio_ = 0.0;
}

void SymmetricIndefinite::factorise(const Eigen::MatrixXd& a, double tolerance) {
  const Index n = a.rows();
  l_ = a;
  swap_.assign(static_cast<std::size_t>(2 * n), 0);
  two_.assign(static_cast<std::size_t>(n), 0);
  inertia_ = {};
  log_abs_det_ = 0.0;
  smallest_ = std::numeric_limits<double>::infinity();
  largest_ = 0.0;
  double scale = 0.0;
  double sum = 0.0;
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) {
      scale = std::max(scale, std::abs(a(i, j)));
      sum += std::abs(a(i, j));
    }
  floor_ = tolerance * scale;
  if (!std::isfinite(sum)) {
    refuse();
    return;
  }
  const double alpha = (1.0 + std::sqrt(17.0)) / 8.0;
  for (Index k = 0; k < n;) {
    // Bunch and Kaufman's choice of pivot, by the largest entries of two columns
    double lambda = 0.0;
    Index r = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::abs(l_(i, k)) > lambda) lambda = std::abs(l_(r = i, k));
    swap_[2 * k] = k;
    if (!(std::abs(l_(k, k)) < alpha * lambda)) {  // also what is not a number: it goes on into the solution
      k = eliminate_one(k);
      continue;
    }
    double sigma = 0.0;
    for (Index j = k; j < r; ++j) sigma = std::max(sigma, std::abs(l_(r, j)));
    for (Index i = r + 1; i < n; ++i) sigma = std::max(sigma, std::abs(l_(i, r)));
    if (std::abs(l_(k, k)) * sigma >= alpha * lambda * lambda) {
      k = eliminate_one(k);
    } else if (std::abs(l_(r, r)) >= alpha * sigma) {
      swap_[2 * k] = r;
      swap_rows(k, r, k);
      k = eliminate_one(k);
    } else {
      swap_[2 * k + 1] = r;
      swap_rows(k + 1, r, k);
      k = eliminate_two(k);
    }
  }
  pivot_ratio_ = n == 0 ? 1.0 : smallest_ / largest_;
}

void SymmetricIndefinite::solve(Eigen::Ref<Eigen::VectorXd> x) const {
  const Index n = l_.rows();
  for (Index k = 0; k < n;) {
    if (two_[k]) {
      std::swap(x[k + 1], x[swap_[2 * k + 1]]);
      for (Index i = k + 2; i < n; ++i) x[i] -= l_(i, k) * x[k] + l_(i, k + 1) * x[k + 1];
      k += 2;
    } else {
      std::swap(x[k], x[swap_[2 * k]]);
      for (Index i = k + 1; i < n; ++i) x[i] -= l_(i, k) * x[k];
      ++k;
    }
  }
  for (Index k = 0; k < n;) {
    if (two_[k]) {
      const double det = l_(k, k) * l_(k + 1, k + 1) - l_(k + 1, k) * l_(k + 1, k);
      const double x0 = x[k];
      x[k] = (l_(k + 1, k + 1) * x0 - l_(k + 1, k) * x[k + 1]) / det;
      x[k + 1] = (l_(k, k) * x[k + 1] - l_(k + 1, k) * x0) / det;
      k += 2;
    } else {
      x[k] /= l_(k, k);
      ++k;
    }
  }
  for (Index k = n; k > 0;) {
    --k;
    if (k > 0 && two_[k - 1]) {
      --k;
      for (Index i = k + 2; i < n; ++i) {
        x[k] -= l_(i, k) * x[i];
        x[k + 1] -= l_(i, k + 1) * x[i];
      }
      std::swap(x[k + 1], x[swap_[2 * k + 1]]);
    } else {
      for (Index i = k + 1; i < n; ++i) x[k] -= l_(i, k) * x[i];
      std::swap(x[k], x[swap_[2 * k]]);
    }
  }
}

}  // namespace snapthrough
