#pragma once
/// @file
/// Inertia of a dense symmetric matrix.

#include <Eigen/Core>

namespace snapthrough::testing {

/// @brief Number of negative eigenvalues, by Bunch and Kaufman's factorisation (Math. Comp. 31, 1977) and
/// Sylvester's law. Only the lower triangle is read.
[[nodiscard]] int negative_eigenvalues(Eigen::MatrixXd a);

}  // namespace snapthrough::testing
