#include "solver/problem/held_motions.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/numeric/dense.h"
#include "solver/numeric/rounding.h"

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
  const SymmetricEigen principal = symmetric_eigen(symmetric_part(stiffness));
  MotionStiffness out;
  out.motions = H * principal.vectors;
  out.stiffness = principal.values.array() - holds->stiffness;
  out.force =
      holds->stiffness * principal.vectors.transpose() * (H.transpose() * y.head(H.rows()) - holds->at);
  return out;
}

namespace {

/// Springs of held_softly(). Source: docs/theory.md, Motions without stiffness; docs/decisions/0022.
struct SoftHolds {
  static constexpr double stiffness = 1e-6;  ///< stiffness of the springs, scaled
  static constexpr double zero = 1e-3;       ///< stiffness of a motion that counts as zero, over the spring's
  static constexpr double firm = 1e5;        ///< stiffness of a motion that resists, over the spring's
  static constexpr double no_force = 1e-6;   ///< force of a spring that counts as zero, over the load
};

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
  return std::max(SoftHolds::no_force * largest, Rounding::force) * actions;
}

SharedHolds held_softly(const EquilibriumProblem& problem) {
  const MatrixXd& motions = problem.free_motions();
  if (motions.cols() == 0) return nullptr;
  return std::make_shared<const Holds>(Holds{motions, VectorXd::Zero(motions.cols()), SoftHolds::stiffness});
}

SoftlyHeld softly_held(EquilibriumProblem& problem, const SharedHolds& soft, const VectorXd& y, double lambda,
                       const Regime& regime) {
  const MotionStiffness met = motion_stiffness(problem, soft, y, lambda, regime);
  const NeutralBounds bounds{SoftHolds::zero * soft->stiffness,
                             no_force(problem, *soft, y, lambda, std::abs(lambda))};
  return {neutral_of(met, y, bounds), met.stiffness.minCoeff() >= SoftHolds::firm * soft->stiffness};
}

SharedHolds neutral_part(EquilibriumProblem& problem, const SharedHolds& holds, const VectorXd& y,
                         double lambda, const NeutralBounds& bounds) {
  return neutral_of(motion_stiffness(problem, holds, y, lambda), y, bounds);
}

}  // namespace snapthrough
