#include "solver/numeric/null_space.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "solver/numeric/pseudo_random.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::SparseMatrix;
using Eigen::VectorXd;

namespace {

/// Numbers of the inverse iteration for null vectors. Chosen, as each of them says.
struct NullSpaceLimits {
  /// Shift over each diagonal entry: keeps the pivots of a singular matrix positive, while a null vector
  /// still grows a hundred times as fast as a vector with |B x| = 1e-6.
  static constexpr double shift = 1e-14;
  static constexpr Index entries = 2'000'000;  ///< most entries of the factor: about half a second
  static constexpr int steps = 30;             ///< most steps of inverse iteration
  static constexpr int refinements = 3;        ///< corrections that make |B x| small to rounding
};

/// Orthogonalises x against orthonormal vectors; the second pass removes rounding of the first.
void make_orthogonal(const std::vector<VectorXd>& others, VectorXd& x) {
  for (int pass = 0; pass < 2; ++pass)
    for (const VectorXd& other : others) x -= other.dot(x) * other;
}

}  // namespace

NullSpace::NullSpace(SparseMatrix<double> rows, SparseMatrix<double> sizes, double tolerance)
    : rows_(std::move(rows)), sizes_(std::move(sizes)), tolerance_(tolerance) {
  SparseMatrix<double> squares = rows_.transpose() * rows_;
  SparseMatrix<double> shift(squares.rows(), squares.cols());
  shift.setIdentity();
  const VectorXd diagonal = squares.diagonal();
  for (Index i = 0; i < shift.cols(); ++i)
    shift.coeffRef(i, i) = NullSpaceLimits::shift * std::max(diagonal[i], 1.0);
  squares += shift;
  factor_.analyzePattern(squares);
  too_dense_ = factor_.entries() > NullSpaceLimits::entries;
  if (!too_dense_) factor_.factorize(squares);
}

/// Excludes the span of earlier vectors' S x, which could make |S x| large everywhere.
bool NullSpace::is_null(const VectorXd& x) const {
  const double left = VectorXd(rows_ * x).lpNorm<Eigen::Infinity>();
  VectorXd size = sizes_ * x;
  make_orthogonal(found_sizes_, size);
  return left <= tolerance_ * size.lpNorm<Eigen::Infinity>() ||
         left <= Rounding::null_vector * x.lpNorm<Eigen::Infinity>();
}

std::optional<VectorXd> NullSpace::next() {
  if (too_dense_ || static_cast<Index>(found_.size()) == rows_.cols()) return std::nullopt;
  VectorXd x = pseudo_random(rows_.cols(), static_cast<unsigned>(found_.size()) + 1U);
  make_orthogonal(found_, x);
  x.normalize();
  double left = std::numeric_limits<double>::infinity();
  for (int step = 0; step < NullSpaceLimits::steps; ++step) {  // until B x gets no smaller
    x = VectorXd(factor_.solve(x));
    make_orthogonal(found_, x);
    x.normalize();
    const double before = std::exchange(left, VectorXd(rows_ * x).norm());
    if (left > 0.5 * before) break;
  }
  if (!is_null(x)) return std::nullopt;
  for (int i = 0; i < NullSpaceLimits::refinements; ++i) {
    const VectorXd rest = rows_ * x;
    x -= VectorXd(factor_.solve(rows_.transpose() * rest));
    make_orthogonal(found_, x);
    x.normalize();
  }
  VectorXd size = sizes_ * x;
  make_orthogonal(found_sizes_, size);
  if (size.norm() > Rounding::null_vector) found_sizes_.push_back(size.normalized());
  found_.push_back(x);
  return x;
}

}  // namespace snapthrough
