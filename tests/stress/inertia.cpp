#include "tests/stress/inertia.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace snapthrough::testing {
namespace {

using Eigen::Index;

/// Swaps rows and columns k and p (k < p) of the part of the lower triangle from k on.
void swap_symmetric(Eigen::MatrixXd& a, Index k, Index p) {
  if (k == p) return;
  const Index n = a.rows();
  std::swap(a(k, k), a(p, p));
  for (Index i = k + 1; i < p; ++i) std::swap(a(i, k), a(p, i));
  for (Index i = p + 1; i < n; ++i) std::swap(a(i, k), a(i, p));
}

/// Whether the pivot at k is to be 2 by 2, after bringing it to the front.
bool choose_pivot(Eigen::MatrixXd& a, Index k) {
  constexpr double kAlpha = 0.6403882032022076;  // (1 + sqrt 17) / 8
  const Index n = a.rows();
  if (k + 1 == n) return false;
  Index r = 0;
  const double lambda = a.col(k).segment(k + 1, n - k - 1).cwiseAbs().maxCoeff(&r);
  r += k + 1;
  if (std::abs(a(k, k)) >= kAlpha * lambda) return false;
  double sigma = 0.0;
  for (Index i = k; i < r; ++i) sigma = std::max(sigma, std::abs(a(r, i)));
  for (Index i = r + 1; i < n; ++i) sigma = std::max(sigma, std::abs(a(i, r)));
  if (std::abs(a(k, k)) * sigma >= kAlpha * lambda * lambda) return false;
  if (std::abs(a(r, r)) >= kAlpha * sigma) {
    swap_symmetric(a, k, r);
    return false;
  }
  if (r != k + 1) {
    swap_symmetric(a, k + 1, r);
    std::swap(a(k + 1, k), a(r, k));
  }
  return true;
}

}  // namespace

int negative_eigenvalues(Eigen::MatrixXd a) {
  const Index n = a.rows();
  int negative = 0;
  for (Index k = 0; k < n;) {
    const bool pair = choose_pivot(a, k);
    const Index rest = n - k - (pair ? 2 : 1);
    if (!pair) {
      const double d = a(k, k);
      if (d < 0.0) ++negative;
      if (d != 0.0 && rest > 0) {
        const Eigen::VectorXd l = a.col(k).tail(rest);
        for (Index j = 0; j < rest; ++j)
          if (l[j] != 0.0) a.col(k + 1 + j).tail(rest - j) -= (l[j] / d) * l.tail(rest - j);
      }
      k += 1;
      continue;
    }
    ++negative;  // Bunch and Kaufman's 2 by 2 pivots have one eigenvalue of either sign
    const double b = a(k + 1, k);
    const double p = a(k, k) / b;
    const double q = a(k + 1, k + 1) / b;
    const double det = p * q - 1.0;
    const Eigen::VectorXd u = a.col(k).tail(rest);
    const Eigen::VectorXd v = a.col(k + 1).tail(rest);
    for (Index j = 0; j < rest; ++j) {
      if (u[j] == 0.0 && v[j] == 0.0) continue;
      const double wu = (q * u[j] - v[j]) / (b * det);
      const double wv = (p * v[j] - u[j]) / (b * det);
      a.col(k + 2 + j).tail(rest - j) -= wu * u.tail(rest - j) + wv * v.tail(rest - j);
    }
    k += 2;
  }
  return negative;
}

}  // namespace snapthrough::testing
