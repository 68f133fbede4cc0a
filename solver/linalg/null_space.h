#pragma once
/// @file
/// Null space of a sparse matrix, vector by vector.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace snapthrough {

/// @brief Vectors x with B x = 0, by inverse iteration with B^T B and one sparse factorisation of it.
///
/// The squares lose half of the digits, so whether x is in the null space is judged by B x itself, and what
/// is left of B x is removed by iterative refinement.
class NullSpace {
 public:
  /// @param rows B, entries of order one
  /// @param sizes what B x is compared with: x counts when |B x| <= `tolerance` |sizes x| or is rounding
  NullSpace(Eigen::SparseMatrix<double> rows, Eigen::SparseMatrix<double> sizes, double tolerance);

  /// @brief Another vector of the null space, of length one and orthogonal to those before; empty when there
  /// is none.
  [[nodiscard]] std::optional<Eigen::VectorXd> next();

 private:
  [[nodiscard]] bool is_null(const Eigen::VectorXd& x) const;

  Eigen::SparseMatrix<double> rows_;
  Eigen::SparseMatrix<double> sizes_;
  double tolerance_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  std::vector<Eigen::VectorXd> found_;        ///< orthonormal
  std::vector<Eigen::VectorXd> found_sizes_;  ///< orthonormal, span their sizes
};

}  // namespace snapthrough
