#include "solver/problem/derivatives.h"

namespace snapthrough {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Size of the difference that tangents are differentiated by: displacement gradients, as the metric has
/// them. Where supports act on one side only it stays within what still touches.
double difference(const EquilibriumProblem& problem) { return problem.one_sided() ? 1e-7 : 1e-4; }

}  // namespace

MatrixXd tangent_change(EquilibriumProblem& problem, const VectorXd& y, double lambda,
                        const PathDirection& along, const Eigen::Ref<const MatrixXd>& b) {
  const double e = difference(problem) / along.norm;
  MatrixXd change = problem.tangent_products(y + e * along.y, lambda + e * along.lambda, b);
  change -= problem.tangent_products(y - e * along.y, lambda - e * along.lambda, b);
  change /= 2.0 * e;
  return change;
}

VectorXd load_change(EquilibriumProblem& problem, const VectorXd& y, double lambda,
                     const PathDirection& along) {
  const double e = difference(problem) / along.norm;
  VectorXd after;
  VectorXd before;
  problem.load(y + e * along.y, lambda + e * along.lambda, after);
  problem.load(y - e * along.y, lambda - e * along.lambda, before);
  return (after - before) / (2.0 * e);
}

}  // namespace snapthrough
