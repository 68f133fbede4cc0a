#include "solver/problem/equilibrium_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snapthrough {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Step of central differences along a direction: displacement gradients, in which the metric measures.
double difference_step(const EquilibriumProblem& problem, const PathDirection& along) {
  constexpr double kGradient = 1e-4;
  constexpr double kWithinContact = 1e-7;  // one-sided supports that touch still touch
  const double square = (problem.metric().array() * along.y.array().square()).sum();
  const double norm = std::sqrt(square + along.lambda * along.lambda);
  return (problem.traits().one_sided ? kWithinContact : kGradient) /
         std::max(norm, std::numeric_limits<double>::min());
}

}  // namespace

MatrixXd EquilibriumProblem::tangent_change(const VectorXd& y, double lambda, const PathDirection& along,
                                            const Eigen::Ref<const MatrixXd>& motions) {
  const double e = difference_step(*this, along);
  MatrixXd change = tangent_products(y + e * along.y, lambda + e * along.lambda, motions);
  change -= tangent_products(y - e * along.y, lambda - e * along.lambda, motions);
  change /= 2.0 * e;
  return change;
}

VectorXd EquilibriumProblem::load_change(const VectorXd& y, double lambda, const PathDirection& along) {
  const double e = difference_step(*this, along);
  VectorXd after;
  VectorXd before;
  load(y + e * along.y, lambda + e * along.lambda, after);
  load(y - e * along.y, lambda - e * along.lambda, before);
  return (after - before) / (2.0 * e);
}

const ModelTraits& EquilibriumProblem::traits() const {
  static const ModelTraits kSmooth;
  return kSmooth;
}

const MatrixXd& EquilibriumProblem::free_motions() const {
  static const MatrixXd kNone;
  return kNone;
}

double EquilibriumProblem::critical_load_scale(const VectorXd&) const {
  return std::numeric_limits<double>::infinity();
}

}  // namespace snapthrough
