#include "solver/problem/holds.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/numeric/dense.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MotionStiffness motion_stiffness(EquilibriumProblem& problem, const SharedHolds& holds, const VectorXd& y,
                                 double lambda, const Regime& regime) {
  const MatrixXd& H = holds->motions;
  problem.set_holds(holds);
  VectorXd residual;
  problem.linearise(y, lambda, residual, regime);
  MatrixXd S(H.cols(), H.cols());
  VectorXd x;
  for (Index i = 0; i < H.cols(); ++i) {
    problem.force_along(H.col(i), x);
    problem.solve(x);
    S.col(i) = H.transpose() * x.head(H.rows());
  }
  const MatrixXd stiffness = inverse(S);
  const SymmetricEigen principal = symmetric_eigen(0.5 * (stiffness + stiffness.transpose()));
  MotionStiffness out;
  out.motions = H * principal.vectors;
  out.stiffness = principal.values.array() - holds->stiffness;
  out.force =
      holds->stiffness * principal.vectors.transpose() * (H.transpose() * y.head(H.rows()) - holds->at);
  return out;
}

namespace {

constexpr double kSoft = 1e-6;         // scaled stiffness of soft holds
constexpr double kShareOfSoft = 1e-3;  // stiffness over kSoft that counts as zero
constexpr double kFirm = 1e5;  // stiffness over kSoft at which soft springs change the state by 1e-5 at most
constexpr double kShareOfLoad = 1e-6;       // spring force over the load that counts as zero
constexpr double kRoundingOfForce = 1e-12;  // rounding of a spring force per unit of the actions

SharedHolds neutral_of(const MotionStiffness& all, const VectorXd& y, const NeutralBounds& bounds) {
  std::vector<Index> neutral;
  for (Index i = 0; i < all.stiffness.size(); ++i)
    if (std::abs(all.stiffness[i]) <= bounds.stiffness && std::abs(all.force[i]) <= bounds.force)
      neutral.push_back(i);
  if (neutral.empty()) return nullptr;
  auto out = std::make_shared<Holds>();
  out->motions = all.motions(Eigen::all, neutral);
  out->at = out->motions.transpose() * y.head(all.motions.rows());
  return out;
}

}  // namespace

double no_force(EquilibriumProblem& problem, const Holds& holds, const VectorXd& y, double lambda,
                double actions) {
  VectorXd load;
  problem.load(y, lambda, load);
  VectorXd along;
  double largest = 0.0;
  for (Index i = 0; i < holds.motions.cols(); ++i) {
    problem.force_along(holds.motions.col(i), along);
    largest = std::max(largest, along.cwiseAbs().dot(load.cwiseAbs()));
  }
  return std::max(kShareOfLoad * largest, kRoundingOfForce) * actions;
}

SharedHolds held_softly(const EquilibriumProblem& problem) {
  const MatrixXd& motions = problem.free_motions();
  if (motions.cols() == 0) return nullptr;
  return std::make_shared<const Holds>(Holds{motions, VectorXd::Zero(motions.cols()), kSoft});
}

SoftlyHeld softly_held(EquilibriumProblem& problem, const SharedHolds& soft, const VectorXd& y, double lambda,
                       const Regime& regime) {
  const MotionStiffness met = motion_stiffness(problem, soft, y, lambda, regime);
  const NeutralBounds bounds{kShareOfSoft * soft->stiffness,
                             no_force(problem, *soft, y, lambda, std::abs(lambda))};
  return {neutral_of(met, y, bounds), met.stiffness.minCoeff() >= kFirm * soft->stiffness};
}

SharedHolds neutral_part(EquilibriumProblem& problem, const SharedHolds& holds, const VectorXd& y,
                         double lambda, const NeutralBounds& bounds) {
  return neutral_of(motion_stiffness(problem, holds, y, lambda), y, bounds);
}

}  // namespace snapthrough
