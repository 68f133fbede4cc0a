#pragma once
/// @file
/// Parts of few columns that are added to a factorised matrix.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace snapthrough {

/// Column of a matrix with few entries: rows with their values.
using SparseColumn = std::vector<std::pair<int, double>>;

/// @brief Converts solutions with S into solutions with J = S + L R^T.
///
/// Sherman-Morrison-Woodbury formula: J^-1 r = x - W M^-1 R^T x,  x = S^-1 r,  W = S^-1 L,  M = 1 + R^T W.
/// det J = det S det M.
class LowRankPart {
 public:
  /// @brief Prepares corrections for the current factors of S.
  /// @param left, right columns of L and R, as many of each
  /// @param size rows of S
  /// @param solve x := S^-1 x for columns of forces on all unknowns
  /// @return M
  Eigen::MatrixXd prepare(std::span<const SparseColumn> left, std::vector<SparseColumn> right,
                          Eigen::Index size, const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve);
  /// x := J^-1 r from x = S^-1 r.
  void correct(Eigen::Ref<Eigen::VectorXd> x) const { x -= W_ * (inverse_ * read(x)); }

 private:
  /// R^T x.
  [[nodiscard]] Eigen::VectorXd read(const Eigen::Ref<const Eigen::VectorXd>& x) const;

  std::vector<SparseColumn> right_;
  Eigen::MatrixXd W_;
  Eigen::MatrixXd inverse_;  ///< M^-1
};

}  // namespace snapthrough
