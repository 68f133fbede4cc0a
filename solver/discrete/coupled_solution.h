#pragma once
/// @file
/// Couplings of elements beside the factors of the tangent that has none.

#include <Eigen/Core>
#include <functional>
#include <span>

#include "solver/discrete/low_rank.h"
#include "solver/element/element_set.h"

namespace snapthrough {

/// @brief Converts solutions with a symmetric tangent S into solutions with J = S + R R^T.
///
/// Column i of R is the row of coupling i over the square root of its compliance. With M of LowRankPart, J
/// has by Sylvester's law of inertia as many negative eigenvalues as S less those of M.
class CoupledSolution {
 public:
  [[nodiscard]] bool empty() const { return empty_; }
  /// @brief Prepares corrections for the current factors of S.
  /// @param solve x := S^-1 x for columns of forces on all unknowns
  void prepare(std::span<const Coupling> couplings, Eigen::Index size,
               const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve);
  /// x := J^-1 r from x = S^-1 r.
  void correct(const Eigen::Ref<Eigen::VectorXd>& x) const { part_.correct(x); }
  /// Number of negative eigenvalues of M.
  [[nodiscard]] int negative() const { return negative_; }
  /// log |det J / det S|.
  [[nodiscard]] double log_abs_det() const { return log_abs_det_; }

 private:
  bool empty_ = true;
  LowRankPart part_;
  int negative_ = 0;
  double log_abs_det_ = 0.0;
};

}  // namespace snapthrough
