#pragma once
/// @file
/// Least squares with unknowns that are not negative.

#include <Eigen/Core>

namespace snapthrough {

/// The x >= 0 that makes |b - A x| least, and what it leaves.
struct NonnegativeSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd residual;  ///< r = b - A x: a_j.r <= 0 for each column, = 0 where x_j > 0
};

/// @brief Solves min |b - A x| over x >= 0 (Lawson and Hanson, Solving Least Squares Problems, 1974, ch. 23).
///
/// The residual is zero, to rounding, if and only if b is in the cone of the columns; else it separates b
/// from that cone: b.r = r.r > 0 and a_j.r <= 0 (the lemma of Farkas).
/// @param A any shape; dense least squares with at most as many columns as there are independent ones are
/// solved
[[nodiscard]] NonnegativeSolution nonnegative_least_squares(const Eigen::MatrixXd& A,
                                                            const Eigen::VectorXd& b);

}  // namespace snapthrough
