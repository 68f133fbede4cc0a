#include "solver/numeric/front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Least size of a pivot over the largest entry of its column.
struct PivotLimits {
  static inline const double share = (1.0 + std::sqrt(17.0)) / 8.0;  ///< Bunch and Kaufman's threshold
  static constexpr double beyond = 0.1;  ///< if that entry's row cannot be a pivot; bounds factors by ten
};

}  // namespace

void PivotSummary::note(double eigenvalue) {
  const double size = std::abs(eigenvalue);
  if (size <= floor) ++inertia.zero;
  if (eigenvalue < 0.0) ++inertia.negative;
  log_abs_det += std::log(std::max(size, std::numeric_limits<double>::min()));
}

/// Exchanges two rows and the corresponding columns, in the matrix and in the factor.
void Front::swap_rows(Index a, Index b) {
  if (a == b) return;
  if (a > b) std::swap(a, b);
  for (Index j = 0; j < a; ++j) std::swap(matrix(a, j), matrix(b, j));
  for (Index j = a + 1; j < b; ++j) std::swap(matrix(j, a), matrix(b, j));
  for (Index j = b + 1; j < matrix.rows(); ++j) std::swap(matrix(j, a), matrix(j, b));
  std::swap(matrix(a, a), matrix(b, b));
  std::swap(unknowns[a], unknowns[b]);
}

void Front::eliminate_one(PivotSummary& pivots) {
  const Index n = matrix.rows();
  const Index k = done_;
  if (matrix(k, k) == 0.0) matrix(k, k) = std::max(pivots.floor, std::numeric_limits<double>::min()) * 1e-3;
  const double d = matrix(k, k);
  pivots.note(d);
  for (Index j = k + 1; j < summed_; ++j) {
    const double f = matrix(j, k) / d;
    if (f == 0.0) continue;
    for (Index i = j; i < n; ++i) matrix(i, j) -= matrix(i, k) * f;
  }
  for (Index i = k + 1; i < n; ++i) matrix(i, k) /= d;
  done_ += 1;
}

void Front::eliminate_two(PivotSummary& pivots) {
  const Index n = matrix.rows();
  const Index k = done_;
  const double a = matrix(k, k);
  const double b = matrix(k + 1, k);
  const double c = matrix(k + 1, k + 1);
  const double det = a * c - b * b;
  const double mean = 0.5 * (a + c);
  const double radius = std::hypot(0.5 * (a - c), b);
  const double far = mean >= 0.0 ? mean + radius : mean - radius;
  pivots.note(far);
  pivots.note(det / far);
  for (Index j = k + 2; j < n; ++j) {
    const double f0 = (c * matrix(j, k) - b * matrix(j, k + 1)) / det;
    const double f1 = (a * matrix(j, k + 1) - b * matrix(j, k)) / det;
    for (Index i = j; i < n && j < summed_; ++i) matrix(i, j) -= matrix(i, k) * f0 + matrix(i, k + 1) * f1;
    matrix(j, k) = f0;
    matrix(j, k + 1) = f1;
  }
  two_[static_cast<std::size_t>(k)] = 1;
  done_ += 2;
}

double Front::largest_in_row(Index row, Index except) const {
  double largest = 0.0;
  for (Index j = done_; j < row; ++j)
    if (j != except) largest = std::max(largest, std::abs(matrix(row, j)));
  for (Index i = row + 1; i < matrix.rows(); ++i)
    if (i != except) largest = std::max(largest, std::abs(matrix(i, row)));
  return largest;
}

/// Returns `row` if it forms a 2 x 2 pivot with row done_ that is not small relative to any row; otherwise 0.
Index Front::choose_beside(Index row, double largest) const {
  if (row == 0) return 0;
  const double a = matrix(done_, done_);
  const double b = matrix(row, done_);
  const double c = matrix(row, row);
  const double det = std::abs(a * c - b * b);
  const double other = largest_in_row(row, done_);
  const double first = std::abs(c) * largest + std::abs(b) * other;
  const double second = std::abs(b) * largest + std::abs(a) * other;
  return std::max(first, second) * PivotLimits::beyond <= det ? row : 0;
}

/// Eliminates row done_, alone or with another row; false: no good pivot.
bool Front::try_pivot(PivotSummary& pivots) {
  const Index k = done_;
  double within = 0.0;  // largest entry in rows that can be pivots
  Index r = 0;
  for (Index i = k + 1; i < summed_; ++i)
    if (std::abs(matrix(i, k)) > within) within = std::abs(matrix(r = i, k));
  double beyond = 0.0;
  for (Index i = summed_; i < matrix.rows(); ++i) beyond = std::max(beyond, std::abs(matrix(i, k)));
  const double largest = std::max(within, beyond);
  const double diagonal = std::abs(matrix(k, k));
  if (!(diagonal < PivotLimits::share * largest)) {  // also for NaN, which then reaches the solution
    eliminate_one(pivots);
  } else if (within >= beyond) {
    const double sigma = std::max(within, largest_in_row(r, k));
    if (diagonal * sigma >= PivotLimits::share * within * within) {
      eliminate_one(pivots);
    } else if (std::abs(matrix(r, r)) >= PivotLimits::share * sigma) {
      swap_rows(k, r);
      eliminate_one(pivots);
    } else {
      swap_rows(k + 1, r);
      eliminate_two(pivots);
    }
  } else if (diagonal >= PivotLimits::beyond * largest) {
    eliminate_one(pivots);
  } else if (const Index other = choose_beside(r, beyond); other != 0) {
    swap_rows(k + 1, other);
    eliminate_two(pivots);
  } else {
    return false;
  }
  return true;
}

void Front::eliminate(Index summed, PivotSummary& pivots) {
  summed_ = summed;
  done_ = 0;
  two_.assign(static_cast<std::size_t>(summed), 0);
  Index refused = 0;  // consecutive rows without a good pivot
  while (done_ + refused < summed_) {
    if (try_pivot(pivots)) {
      refused = 0;
      continue;
    }
    ++refused;
    swap_rows(done_, summed_ - refused);  // try the next row
  }
  update_rest();
}

/// Subtracts the contributions of all pivots from the remaining rows in one product.
void Front::update_rest() {
  const Index rest = matrix.rows() - summed_;
  if (rest == 0 || done_ == 0) return;
  const auto factor = matrix.block(summed_, 0, rest, done_);
  scaled_.resize(rest, done_);
  for (Index k = 0; k < done_; ++k) {
    scaled_.col(k) = matrix(k, k) * factor.col(k);
    if (!two_[static_cast<std::size_t>(k)]) continue;
    const double b = matrix(k + 1, k);
    scaled_.col(k) += b * factor.col(k + 1);
    scaled_.col(k + 1) = b * factor.col(k) + matrix(k + 1, k + 1) * factor.col(k + 1);
    ++k;
  }
  matrix.bottomRightCorner(rest, rest).triangularView<Eigen::Lower>() -= scaled_ * factor.transpose();
}

void Front::forward(VectorXd& x) const {
  const Index n = matrix.rows();
  for (Index k = 0; k < done_;) {
    if (two_[static_cast<std::size_t>(k)]) {
      for (Index i = k + 2; i < n; ++i) x[i] -= matrix(i, k) * x[k] + matrix(i, k + 1) * x[k + 1];
      k += 2;
    } else {
      for (Index i = k + 1; i < n; ++i) x[i] -= matrix(i, k) * x[k];
      ++k;
    }
  }
}

void Front::scale(VectorXd& x) const {
  for (Index k = 0; k < done_;) {
    if (two_[static_cast<std::size_t>(k)]) {
      const double det = matrix(k, k) * matrix(k + 1, k + 1) - matrix(k + 1, k) * matrix(k + 1, k);
      const double x0 = x[k];
      x[k] = (matrix(k + 1, k + 1) * x0 - matrix(k + 1, k) * x[k + 1]) / det;
      x[k + 1] = (matrix(k, k) * x[k + 1] - matrix(k + 1, k) * x0) / det;
      k += 2;
    } else {
      x[k] /= matrix(k, k);
      ++k;
    }
  }
}

void Front::backward(VectorXd& x) const {
  const Index n = matrix.rows();
  for (Index k = done_; k > 0;) {
    --k;
    if (k > 0 && two_[static_cast<std::size_t>(k - 1)]) {
      --k;
      for (Index i = k + 2; i < n; ++i) {
        x[k] -= matrix(i, k) * x[i];
        x[k + 1] -= matrix(i, k + 1) * x[i];
      }
    } else {
      for (Index i = k + 1; i < n; ++i) x[k] -= matrix(i, k) * x[i];
    }
  }
}

}  // namespace snapthrough
