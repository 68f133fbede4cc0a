#include "solver/discrete/low_rank.h"

#include <cstddef>

#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd LowRankPart::read(const Eigen::Ref<const VectorXd>& x) const {
  VectorXd out = VectorXd::Zero(static_cast<Index>(right_.size()));
  for (std::size_t k = 0; k < right_.size(); ++k)
    for (const auto& [row, value] : right_[k]) out[static_cast<Index>(k)] += value * x[row];
  return out;
}

Eigen::MatrixXd LowRankPart::prepare(std::span<const SparseColumn> left, std::vector<SparseColumn> right,
                                     Index size,
                                     const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve) {
  right_ = std::move(right);
  const auto count = static_cast<Index>(left.size());
  W_.setZero(size, count);
  for (Index k = 0; k < count; ++k)
    for (const auto& [row, value] : left[static_cast<std::size_t>(k)]) W_(row, k) += value;
  solve(W_);
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(count, count);
  for (Index k = 0; k < count; ++k) M.col(k) += read(W_.col(k));
  inverse_ = inverse(M);
  return M;
}

}  // namespace snapthrough
