#include "solver/discrete/coupled_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/numeric/dense.h"

namespace snapthrough {

void CoupledSolution::prepare(std::span<const Coupling> couplings, Eigen::Index size,
                              const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve) {
  empty_ = couplings.empty();
  negative_ = 0;
  log_abs_det_ = 0.0;
  if (empty_) return;
  std::vector<SparseColumn> columns;
  for (const Coupling& coupling : couplings) {
    SparseColumn& column = columns.emplace_back(coupling.row);
    for (auto& [row, value] : column) value /= std::sqrt(coupling.compliance);
  }
  for (const double value :
       symmetric_eigenvalues(symmetric_part(part_.prepare(columns, columns, size, solve)))) {
    if (value < 0.0) ++negative_;
    log_abs_det_ += std::log(std::max(std::abs(value), std::numeric_limits<double>::min()));
  }
}

}  // namespace snapthrough
