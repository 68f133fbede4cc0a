#include "solver/discrete/coupled_solution.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd CoupledSolution::along(const Eigen::Ref<const VectorXd>& x) const {
  VectorXd out(static_cast<Index>(couplings_.size()));
  for (std::size_t i = 0; i < couplings_.size(); ++i)
    out[static_cast<Index>(i)] = couplings_[i].value(x.data()) / std::sqrt(couplings_[i].compliance);
  return out;
}

void CoupledSolution::prepare(std::span<const Coupling> couplings, Index size,
                              const std::function<void(Eigen::Ref<MatrixXd>)>& solve) {
  couplings_.assign(couplings.begin(), couplings.end());
  negative_ = 0;
  log_abs_det_ = 0.0;
  if (couplings_.empty()) return;
  const auto count = static_cast<Index>(couplings_.size());
  W_.setZero(size, count);
  for (Index i = 0; i < count; ++i) {
    const Coupling& coupling = couplings_[static_cast<std::size_t>(i)];
    coupling.push(1.0 / std::sqrt(coupling.compliance), W_.col(i).data());
  }
  solve(W_);
  MatrixXd M = MatrixXd::Identity(count, count);
  for (Index i = 0; i < count; ++i) M.col(i) += along(W_.col(i));
  M = symmetric_part(M);
  for (const double value : symmetric_eigenvalues(M)) {
    if (value < 0.0) ++negative_;
    log_abs_det_ += std::log(std::max(std::abs(value), std::numeric_limits<double>::min()));
  }
  inverse_ = inverse(M);
}

void CoupledSolution::correct(Eigen::Ref<VectorXd> x) const { x -= W_ * (inverse_ * along(x)); }

}  // namespace snapthrough
