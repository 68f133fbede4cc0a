/// What a critical point of CriticalSolution says: its imperfection, its spectrum, the paths through it.

#include <cmath>
#include <cstddef>

#include "solver/events/critical_system.h"
#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Newton iterations on the amplitudes of a tangent.
constexpr int kAmplitudeIterations = 5;

/// Direction n a + z b in (y, lambda), normalised, with the rate of the first null motion's stiffness.
CriticalDirection direction(const CriticalSolution& at, const VectorXd& along_null, double along_load,
                            const PathMetric& metric) {
  CriticalDirection out{at.null * along_null + along_load * at.response, along_load, 0.0};
  const double norm = metric.norm(out.y, out.lambda);
  out.y /= norm;
  out.lambda /= norm;
  out.stiffness_rate = along_load * at.B(0, 0);
  for (Index k = 0; k < along_null.size(); ++k)
    out.stiffness_rate += along_null[k] * at.A[static_cast<std::size_t>(k)](0, 0);
  out.stiffness_rate /= norm;
  return out;
}

}  // namespace

double CriticalSolution::imperfection() const {
  if (unfolding.size() == 0 || unfolding.isZero(0.0)) return 0.0;
  return unfolding.norm() /
         (std::abs(lambda) * symmetric_eigenvalues(symmetric_part(B)).cwiseAbs().minCoeff());
}

std::optional<CriticalSolution::Spectrum> CriticalSolution::spectrum() const {
  // eigenproblem (stiffness + d B) w = 0
  const double sign = B(0, 0) < 0.0 ? -1.0 : 1.0;
  const MatrixXd definite = symmetric_part(-sign * B);
  if ((symmetric_eigenvalues(symmetric_part(definite)).array() >= 0.0).any()) return std::nullopt;
  const SymmetricEigen pairs = generalised_symmetric_eigen(symmetric_part(stiffness), -definite);
  const Index k = stiffness.cols();
  Spectrum out{-sign * pairs.values, pairs.vectors};
  if (sign > 0.0) {
    out.distances = out.distances.reverse().eval();
    out.shares = out.shares.rowwise().reverse().eval();
  }
  for (Index i = 0; i < k; ++i) out.shares.col(i).normalize();
  return out;
}

std::vector<CriticalDirection> CriticalSolution::tangents(const PathMetric& metric) const {
  // solves n_i.F''[t, t] = 0 for t = z b + n a
  const Index k = C.size();
  if (k == 1) {
    const double a = A[0](0, 0);
    const double b = B(0, 0);
    const double root = b * b - a * C[0];
    if (!(root > 0.0)) return {};
    const double big = -(b + std::copysign(std::sqrt(root), b));
    return {direction(*this, C, big, metric), direction(*this, VectorXd::Constant(1, big), a, metric)};
  }
  VectorXd a = VectorXd::Zero(k);
  for (int it = 0; it < kAmplitudeIterations; ++it) {
    MatrixXd change = B;
    for (Index j = 0; j < k; ++j) change.col(j) += A[static_cast<std::size_t>(j)] * a;
    const VectorXd value = B * a + change * a + C;
    a -= 0.5 * solve_full_pivoting(change, value);
  }
  if (!a.allFinite()) return {};
  return {direction(*this, a, 1.0, metric)};
}

}  // namespace snapthrough
