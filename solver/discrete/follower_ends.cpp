#include "solver/discrete/follower_ends.h"

#include <array>
#include <cstddef>

#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Displacement of an end.
std::array<double, 2> displacement(const FollowerEnd& end, const Eigen::Ref<const VectorXd>& x) {
  std::array<double, 2> out{0.0, 0.0};
  for (const FollowerEnd::Term& term : end.terms) {
    out[0] += term.weight * x[term.x];
    out[1] += term.weight * x[term.y];
  }
  return out;
}

}  // namespace

/// Product A E^T x.
VectorXd FollowerEnds::weighted(const Eigen::Ref<const VectorXd>& x) const {
  VectorXd out(2 * static_cast<Index>(ends_.size()));
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const Index row = 2 * static_cast<Index>(i);
    const std::array<double, 2> u = displacement(ends_[i], x);
    out[row] = -c_[i] * u[1];
    out[row + 1] = c_[i] * u[0];
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
  for (Index j = 0; j < n; ++j)
    for (const FollowerEnd::Term& term : ends_[static_cast<std::size_t>(j / 2)].terms)
      W_(j % 2 == 0 ? term.x : term.y, j) = term.weight;
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
    const std::array<double, 2> u = displacement(end, direction);
    for (const FollowerEnd::Term& term : end.terms) {
      out[term.x] -= c * term.weight * u[1];
      out[term.y] += c * term.weight * u[0];
    }
  }
}

}  // namespace snapthrough
