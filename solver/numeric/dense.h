#pragma once
/// @file
/// Decompositions of dense matrices, compiled once: Eigen's templates for them cost seconds in every file
/// that names one. Sizes are checked by Eigen's assertions in builds that have them.

#include <Eigen/Core>

namespace snapthrough {

/// @brief (A + A^T) / 2.
[[nodiscard]] Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& A);

/// Eigenvalues ascending, and an eigenvector for each in the columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// @brief A x = v x for a symmetric A, of which the lower triangle is read; vectors are orthonormal.
[[nodiscard]] SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);

/// @brief Eigenvalues of a symmetric A, ascending; the lower triangle is read.
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);

/// @brief A x = v B x for a symmetric A and a symmetric, positive definite B; vectors satisfy x^T B x = 1.
[[nodiscard]] SymmetricEigen generalised_symmetric_eigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Real parts of eigenvalues, unsorted, and of the eigenvectors in the columns.
struct RealEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// @brief A x = v x for a square A whose eigenvalues are real but for rounding. All are NaN where A has
/// entries that are not finite, or the iteration fails.
[[nodiscard]] RealEigen real_eigen(const Eigen::MatrixXd& A);

/// Eigenvalues, unsorted, and an eigenvector for each in the columns.
struct ComplexEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

/// @brief A x = v x for a square A. All are NaN as of real_eigen().
[[nodiscard]] ComplexEigen complex_eigen(const Eigen::MatrixXd& A);

/// @brief A^-1 by LU factors with row pivoting; not finite when A is singular.
[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);

/// @brief det A by LU factors with row pivoting.
[[nodiscard]] double determinant(const Eigen::MatrixXd& A);

/// @brief A^-1 B by LU factors with row pivoting.
[[nodiscard]] Eigen::MatrixXd solve_row_pivoting(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// @brief A^-1 b by LU factors with full pivoting; a solution of the leading equations when A is singular.
[[nodiscard]] Eigen::VectorXd solve_full_pivoting(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// @brief V U^-1 with the Cholesky factor of V's Gram matrix U^T U: columns that are orthonormal in the inner
/// product of that matrix.
[[nodiscard]] Eigen::MatrixXd orthonormal_by_gram(const Eigen::MatrixXd& V, const Eigen::MatrixXd& gram);

/// @brief x with the least |A x - b|, by QR factors with column pivoting.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// @brief Columns of A that span its range, in the order of column pivoting.
/// @param threshold pivots below this share of the largest one are zero
[[nodiscard]] Eigen::MatrixXd independent_columns(const Eigen::MatrixXd& A, double threshold);

/// @brief Orthonormal basis of the range of A, by QR factors with column pivoting.
/// @param threshold pivots below this share of the largest one are zero
[[nodiscard]] Eigen::MatrixXd orthonormal_span(const Eigen::MatrixXd& A, double threshold);

/// @brief Q of A = Q R without pivoting: as many orthonormal columns as A has, which has full rank.
[[nodiscard]] Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& A);

}  // namespace snapthrough
