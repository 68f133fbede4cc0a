#pragma once
/// @file
/// Null space of a sparse matrix.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace snapthrough {

/// @brief Computes vectors x with B x = 0 by inverse iteration on B^T B, with one sparse factorisation.
///
/// Squaring loses half of the digits; therefore B x itself decides on membership, and iterative refinement
/// reduces B x.
class NullSpace {
 public:
  /// @param rows B, with entries of order one
  /// @param sizes reference S: x is accepted when |B x| <= `tolerance` |S x|, or when B x is rounding
  NullSpace(Eigen::SparseMatrix<double> rows, Eigen::SparseMatrix<double> sizes, double tolerance);

  /// @brief Whether factorising B^T B was omitted because of its fill-in; next() then returns no vector.
  [[nodiscard]] bool too_dense() const { return too_dense_; }

  /// @brief Next vector of the null space, of length one and orthogonal to the previous ones; empty: none.
  [[nodiscard]] std::optional<Eigen::VectorXd> next();

 private:
  /// Exposes the number of entries of the factor after symbolic analysis.
  class Factor : public Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> {
   public:
    [[nodiscard]] Eigen::Index entries() const { return m_matrix.nonZeros(); }
  };

  [[nodiscard]] bool is_null(const Eigen::VectorXd& x) const;

  Eigen::SparseMatrix<double> rows_;
  Eigen::SparseMatrix<double> sizes_;
  double tolerance_;
  Factor factor_;
  bool too_dense_ = false;
  std::vector<Eigen::VectorXd> found_;        ///< orthonormal null vectors
  std::vector<Eigen::VectorXd> found_sizes_;  ///< orthonormal basis of the span of S x
};

}  // namespace snapthrough
