#include "solver/member/chain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace snapthrough {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Certainty of pivots in joining elements; ratios. Source: docs/decisions/0001, Price; docs/decisions/0022.
struct PivotLimits {
  static constexpr double cancelled = 1e-3;     ///< pivot over its terms, below which its sign is uncertain
  static constexpr double smallest = 1e-2;      ///< least certain pivot of the identity plus a matrix
  static constexpr int balance_passes = 4;      ///< iterations of the scaling
  static constexpr double large_gain = 1e3;     ///< error amplification above which alternatives are tried
  static constexpr double poor_quality = 1e-3;  ///< reciprocal condition below which alternatives are tried
  static constexpr double much_better = 10.0;   ///< factor by which an alternative pivot must improve
  static constexpr int ahead = 4;               ///< elements joined to each other first, at most
};

/// F = L J L^T with J = diag(+-1); L has zero columns for rigid directions.
struct SignedRoot {
  Matrix3d L = Matrix3d::Zero();
  Vector3d J = Vector3d::Ones();
  int minus = 0;  ///< number of -1 in J
};

/// Signed root of F; empty when F is not semidefinite and the sign of a pivot is uncertain.
std::optional<SignedRoot> signed_root(const Matrix3d& F) {
  SignedRoot out;
  Matrix3d& L = out.L;
  const double floor = 1e-13 * std::max({std::abs(F(0, 0)), std::abs(F(1, 1)), std::abs(F(2, 2))});
  bool clear = true;
  for (int j = 0; j < 3; ++j) {
    double d = F(j, j);
    double size = std::abs(d);
    for (int k = 0; k < j; ++k) {
      d -= out.J[k] * L(j, k) * L(j, k);
      size += L(j, k) * L(j, k);
    }
    if (d >= -floor && d <= 1e-3 * floor) continue;  // a rigid direction
    clear = clear && std::abs(d) > PivotLimits::cancelled * size;
    if (d < 0.0) {
      out.J[j] = -1.0;
      ++out.minus;
    }
    if (out.minus > 0 && !clear) return std::nullopt;
    L(j, j) = std::sqrt(std::abs(d));
    for (int i = j + 1; i < 3; ++i) {
      double sum = F(i, j);
      for (int k = 0; k < j; ++k) sum -= out.J[k] * L(i, k) * L(j, k);
      L(i, j) = out.J[j] * sum / L(j, j);
    }
  }
  return out;
}

/// Scales the largest entry of each row to about one by a diagonal congruence transformation.
template <int N>
void balance(Eigen::Matrix<double, N, N>& A) {
  for (int pass = 0; pass < PivotLimits::balance_passes; ++pass) {
    std::array<double, N> d;
    for (int i = 0; i < N; ++i)
      d[i] = 1.0 / std::sqrt(std::max(A.col(i).cwiseAbs().maxCoeff(), std::numeric_limits<double>::min()));
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) A(i, j) *= d[i] * d[j];
  }
}

template <int N>
void exchange(Eigen::Matrix<double, N, N>& A, int i, int j) {
  if (i == j) return;
  A.row(i).swap(A.row(j));
  A.col(i).swap(A.col(j));
}

/// Number of negative eigenvalues of a symmetric matrix with rows of very different magnitude: negative
/// pivots after balancing, because the error of a pivot is relative to the largest entry. Complete pivoting
/// (Bunch and Parlett, SIAM J. Numer. Anal. 8, 1971) bounds growth; a 2 x 2 pivot has one eigenvalue of each
/// sign.
template <int N>
int count_negative(Eigen::Matrix<double, N, N> A) {
  const double alpha = (1.0 + std::sqrt(17.0)) / 8.0;
  balance(A);
  int negative = 0;
  for (int k = 0; k < N;) {
    int one = k;
    int row = k;
    int col = k;
    for (int j = k; j < N; ++j) {
      if (std::abs(A(j, j)) > std::abs(A(one, one))) one = j;
      for (int i = j + 1; i < N; ++i)
        if (row == col || std::abs(A(i, j)) > std::abs(A(row, col))) row = i, col = j;
    }
    const double diagonal = std::abs(A(one, one));
    if (row == col || diagonal >= alpha * std::abs(A(row, col))) {
      if (diagonal == 0.0) break;
      exchange(A, k, one);
      if (A(k, k) < 0.0) ++negative;
      for (int j = k + 1; j < N; ++j) {
        const double f = A(j, k) / A(k, k);
        for (int i = k + 1; i < N; ++i) A(i, j) -= A(i, k) * f;
      }
      ++k;
      continue;
    }
    exchange(A, k, col);
    exchange(A, k + 1, row);
    ++negative;
    const double det = A(k, k) * A(k + 1, k + 1) - A(k + 1, k) * A(k + 1, k);
    for (int j = k + 2; j < N; ++j) {
      const double f = (A(k + 1, k + 1) * A(j, k) - A(k + 1, k) * A(j, k + 1)) / det;
      const double g = (A(k, k) * A(j, k + 1) - A(k + 1, k) * A(j, k)) / det;
      for (int i = k + 2; i < N; ++i) A(i, j) -= A(i, k) * f + A(i, k + 1) * g;
    }
    k += 2;
  }
  return negative;
}

/// Number of negative pivots of C = L D L^T; empty if a pivot is near zero or results from cancellation, so
/// that its sign is uncertain without balancing and pivoting.
std::optional<int> clearly_negative(const Matrix3d& C) {
  int negative = 0;
  const auto clear = [&](double d, double size) {
    negative += d < 0.0 ? 1 : 0;
    return std::abs(d) > std::max(PivotLimits::smallest, PivotLimits::cancelled * size);
  };
  const double d0 = C(0, 0);
  if (!clear(d0, 0.0)) return std::nullopt;
  const double l10 = C(1, 0) / d0;
  const double l20 = C(2, 0) / d0;
  const double d1 = C(1, 1) - l10 * C(1, 0);
  if (!clear(d1, std::abs(C(1, 1)) + std::abs(l10 * C(1, 0)))) return std::nullopt;
  const double left = C(2, 1) - l20 * C(1, 0);
  const double d2 = C(2, 2) - l20 * C(2, 0) - left / d1 * left;
  const double size = std::abs(C(2, 2)) + std::abs(l20 * C(2, 0)) +
                      (std::abs(C(2, 1)) + std::abs(l20 * C(1, 0))) * std::abs(left / d1);
  if (!clear(d2, size)) return std::nullopt;
  return negative;
}

/// Matrix product, inlined for speed.
template <class Left, class Right>
[[gnu::always_inline]] inline Matrix3d product(const Left& A, const Right& B) {
  Matrix3d out;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) out(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
  return out;
}

/// Returns the symmetric part of a matrix that is symmetric but for rounding.
Matrix3d symmetric(const Matrix3d& A) {
  Matrix3d out;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) out(i, j) = 0.5 * (A(i, j) + A(j, i));
  return out;
}

}  // namespace

/// With F = L J L^T the matrix is congruent to [[-J, I], [I, L^T K L]]; its negative eigenvalues number those
/// of -J plus those of C = J + L^T K L.
int extra_negative(const Matrix3d& F, const Matrix3d& K) {
  if (const auto root = signed_root(F)) {
    Matrix3d C = product(root->L.transpose(), product(K, root->L));
    for (int i = 0; i < 3; ++i) C(i, i) += root->J[i];
    if (const auto negative = clearly_negative(C)) return *negative - root->minus;
    if (root->minus == 0) return count_negative<3>(C);
  }
  Eigen::Matrix<double, 6, 6> A;
  A << -F, Matrix3d::Identity(), Matrix3d::Identity(), K;
  return count_negative<6>(A) - 3;
}

Chain::Pivot Chain::pivot_of(const Run& first, const Run& second) {
  Matrix3d matrix = product(second.K, first.F);
  for (int i = 0; i < 3; ++i) matrix(i, i) += 1.0;
  Pivot pivot{SmallFactor(matrix)};
  const double size = pivot.factor.inverse().cwiseAbs().maxCoeff();
  pivot.gain = std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
  pivot.quality = 1.0 / (pivot.gain * matrix.cwiseAbs().maxCoeff());
  return pivot;
}

void Chain::join(Run& first, const Run& second, const Pivot& pivot) {
  Join& join = joins_.emplace_back();
  join.first_first = first.first;
  join.second_first = second.first;
  join.second_last = second.last;
  join.X = first.X;
  join.F = first.F;
  join.K2 = second.K;
  join.X2 = second.X;
  join.pivot = pivot.factor;
  ends_.negative += extra_negative(first.F, second.K);
  ends_.log_det += std::log(std::abs(pivot.factor.determinant()));
  const Matrix3d MKX = join.pivot.solve_columns(product(second.K, join.X));
  first.K = symmetric(first.K + product(join.X.transpose(), MKX));
  first.X = -product(second.X, Matrix3d(join.X - product(join.F, MKX)));
  // F M is symmetric, because F is
  first.F = symmetric(second.F + product(second.X, product(join.pivot.solve_columns_transposed(join.F),
                                                           second.X.transpose())));
  first.last = second.last;
}

/// Joins the next element, or several next elements at once if their pivot is much better: first by error
/// amplification, then by certainty of sign.
void Chain::join_next(Run& all, std::span<const CondensedElement> elements) {
  const auto run_of = [&elements](int i) { return Run{elements[i].K, elements[i].X, elements[i].F, i, i}; };
  const int next = all.last + 1;
  const Pivot pivot = pivot_of(all, run_of(next));
  const bool grows = pivot.gain > PivotLimits::large_gain;
  if (grows || pivot.quality < PivotLimits::poor_quality) {
    const auto saved = ends_;
    const std::size_t joins = joins_.size();
    Run ahead = run_of(next);
    const int last = std::min(next + (grows ? PivotLimits::ahead : 2), static_cast<int>(elements.size())) - 1;
    while (ahead.last < last) {
      const Run after = run_of(ahead.last + 1);
      join(ahead, after, pivot_of(ahead, after));
      const Pivot other = pivot_of(all, ahead);
      const bool better =
          grows ? other.gain * PivotLimits::much_better < pivot.gain
                : other.quality > PivotLimits::much_better * pivot.quality && other.gain <= pivot.gain;
      if (!better) continue;
      join(all, ahead, other);
      return;
    }
    joins_.resize(joins);
    ends_ = saved;
  }
  join(all, run_of(next), pivot);
}

void Chain::factorise(std::span<const CondensedElement> elements) {
  joins_.clear();
  joins_.reserve(elements.size());
  ends_.negative = 0;
  ends_.log_det = 0.0;
  for (const CondensedElement& element : elements) {
    ends_.negative += element.negative;
    ends_.log_det += element.log_det;
  }
  Run all{elements[0].K, elements[0].X, elements[0].F, 0, 0};
  while (all.last + 1 < static_cast<int>(elements.size())) join_next(all, elements);
  ends_.K = all.K;
  ends_.X = all.X;
  ends_.F = all.F;
}

CondensedForces Chain::reduce(std::span<CondensedForces> elements, std::span<const ElementDofs> dofs,
                              const ColumnLanes& rhs) const {
  for (const Join& join : joins_) {
    CondensedForces& first = elements[join.first_first];  // holds the data of its run so far
    CondensedForces& second = elements[join.second_first];
    const Lanes3 c1 = first.rm;
    Lanes3 c2 = second.ra;
    for (int c = 0; c < 3; ++c) c2[c] += rhs[dofs[join.second_first].a[c]];
    const Lanes3 m = join.pivot.solve(difference(c2, times(join.K2, c1)));
    first.ra = difference(first.ra, transposed_times(join.X, m));
    first.rm = difference(second.rm, times(join.X2, sum(c1, times(join.F, m))));
    // the second run is not used again
    second.rm = c1;
    second.ra = c2;
  }
  return elements[0];
}

void Chain::recover(std::span<const CondensedForces> elements, std::span<const ElementDofs> dofs,
                    const ColumnLanes& x) const {
  for (auto join = joins_.rbegin(); join != joins_.rend(); ++join) {
    const auto& start = dofs[join->first_first].a;
    const int last = dofs[join->second_last].m;
    const Lanes3 us{x[start[0]], x[start[1]], x[start[2]]};
    const Lanes3 end{x[last], x[last + 1], x[last + 2]};
    const CondensedForces& second = elements[join->second_first];
    const Lanes3 free = difference(second.rm, times(join->X, us));
    const Lanes3 m =
        join->pivot.solve(difference(second.ra, sum(transposed_times(join->X2, end), times(join->K2, free))));
    const Lanes3 u = sum(free, times(join->F, m));
    const ElementDofs& node = dofs[join->second_first];
    const int force = dofs[join->second_first - 1].m;
    for (int c = 0; c < 3; ++c) {
      x.store(node.a[c], u[c]);
      x.store(force + c, m[c]);
    }
  }
}

}  // namespace snapthrough
