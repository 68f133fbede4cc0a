#pragma once
/// @file
/// Couplings of elements beside the factors of the tangent that has none.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "solver/element/element_set.h"

namespace snapthrough {

/// @brief Converts solutions with a symmetric tangent S into solutions with J = S + R R^T.
///
/// Column i of R is the row of coupling i over the square root of its compliance. Sherman-Morrison-Woodbury
/// formula: J^-1 r = x - W M^-1 R^T x,  x = S^-1 r,  W = S^-1 R,  M = I + R^T W. By Sylvester's law of
/// inertia J has as many negative eigenvalues as S less those of M; det J = det S det M.
class CoupledSolution {
 public:
  [[nodiscard]] bool empty() const { return couplings_.empty(); }
  /// @brief Prepares corrections for the current factors of S.
  /// @param solve x := S^-1 x for columns of forces on all unknowns
  void prepare(std::span<const Coupling> couplings, Eigen::Index size,
               const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve);
  /// x := J^-1 r from x = S^-1 r.
  void correct(Eigen::Ref<Eigen::VectorXd> x) const;
  /// Number of negative eigenvalues of M.
  [[nodiscard]] int negative() const { return negative_; }
  /// log |det J / det S|.
  [[nodiscard]] double log_abs_det() const { return log_abs_det_; }

 private:
  /// R^T x.
  [[nodiscard]] Eigen::VectorXd along(const Eigen::Ref<const Eigen::VectorXd>& x) const;

  std::vector<Coupling> couplings_;
  Eigen::MatrixXd W_;
  Eigen::MatrixXd inverse_;  ///< M^-1
  int negative_ = 0;
  double log_abs_det_ = 0.0;
};

}  // namespace snapthrough
