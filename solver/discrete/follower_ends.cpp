#include "solver/discrete/follower_ends.h"

#include <cstddef>

#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

/// Product A E^T x.
VectorXd FollowerEnds::weighted(const Eigen::Ref<const VectorXd>& x) const {
  VectorXd out(2 * static_cast<Index>(ends_.size()));
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const Index row = 2 * static_cast<Index>(i);
    out[row] = -c_[i] * x[3 * ends_[i].node + 1];
    out[row + 1] = c_[i] * x[3 * ends_[i].node];
  }
  return out;
}

double FollowerEnds::prepare(double proportional, double constant, Index size,
                             const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve) {
  c_.clear();
  for (const FollowerEnd& end : ends_)
    c_.push_back(proportional * end.proportional + constant * end.constant);
  const Index n = 2 * static_cast<Index>(ends_.size());
  W_.setZero(size, n);
  for (Index j = 0; j < n; ++j) W_(3 * ends_[static_cast<std::size_t>(j / 2)].node + j % 2, j) = 1.0;
  solve(W_);
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
  for (Index j = 0; j < n; ++j) M.col(j) += weighted(W_.col(j));
  inverse_ = inverse(M);
  return determinant(M);
}

void FollowerEnds::correct(Eigen::Ref<VectorXd> x) const { x -= W_ * (inverse_ * weighted(x)); }

void FollowerEnds::add_product(double proportional, double constant,
                               const Eigen::Ref<const VectorXd>& direction, Eigen::Ref<VectorXd> out) const {
  for (const FollowerEnd& end : ends_) {
    const double c = proportional * end.proportional + constant * end.constant;
    out[3 * end.node] -= c * direction[3 * end.node + 1];
    out[3 * end.node + 1] += c * direction[3 * end.node];
  }
}

}  // namespace snapthrough
