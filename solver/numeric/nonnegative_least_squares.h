#pragma once
/// @file
/// Non-negative least squares.

#include <Eigen/Core>

namespace snapthrough {

/// Minimiser x >= 0 of |b - A x| with its residual.
struct NonnegativeSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd residual;  ///< r = b - A x: a_j.r <= 0 for each column, = 0 where x_j > 0
};

/// @brief Solves min |b - A x| over x >= 0 (Lawson and Hanson, Solving Least Squares Problems, 1974, ch. 23).
///
/// The residual is zero up to rounding if and only if b is in the cone of the columns of A; otherwise it
/// separates b from that cone: b.r = r.r > 0 and a_j.r <= 0 (Farkas' lemma).
/// @param A any shape; dense subproblems have at most rank(A) columns
[[nodiscard]] NonnegativeSolution nonnegative_least_squares(const Eigen::MatrixXd& A,
                                                            const Eigen::VectorXd& b);

}  // namespace snapthrough
