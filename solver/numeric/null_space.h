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

  /// @brief Whether B^T B fills up so much when it is factorised that it is left: some seconds would be too
  /// few. next() knows no vector then.
  [[nodiscard]] bool too_dense() const { return too_dense_; }

  /// @brief Another vector of the null space, of length one and orthogonal to those before; empty when there
  /// is none.
  [[nodiscard]] std::optional<Eigen::VectorXd> next();

 private:
  /// Tells how many entries its factor will have once the pattern is analysed.
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
  std::vector<Eigen::VectorXd> found_;        ///< orthonormal
  std::vector<Eigen::VectorXd> found_sizes_;  ///< orthonormal, span their sizes
};

}  // namespace snapthrough
