#include "solver/path/soft_mode.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/numeric/dense.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double SoftModes::distance_to_zero(Index mode, double sense) const {
  const double distance = -sense * stiffness[mode] / rate[mode];
  return distance >= 0.0 ? distance : std::numeric_limits<double>::infinity();
}

namespace {

/// A block of motions z with the motions x that they come from, J z = W x.
struct Block {
  MatrixXd z;
  MatrixXd x;
};

/// a.W b with the diagonal W of the metric.
template <class A, class B>
double inner(const VectorXd& weights, const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return (a.array() * weights.array() * b.array()).sum();
}

/// Makes the motions orthonormal in the metric; columns that depend on earlier ones are dropped.
void orthonormalise(const VectorXd& weights, Block& block) {
  constexpr double kDependent = 1e-12;
  Index kept = 0;
  for (Index i = 0; i < block.z.cols(); ++i) {
    auto z = block.z.col(i);
    auto x = block.x.col(i);
    const auto norm = [&] { return std::sqrt(inner(weights, z, z)); };
    const double size = norm();
    double left = size;
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough where the first cancelled most of the column
      for (Index j = 0; j < kept; ++j) {
        const double along = inner(weights, block.z.col(j), z);
        z -= along * block.z.col(j);
        x -= along * block.x.col(j);
      }
      if (kept > 0) left = norm();
      if (!(left > kDependent * size)) break;
    }
    if (!(left > kDependent * size)) continue;
    block.z.col(kept) = z / left;
    block.x.col(kept) = x / left;
    ++kept;
  }
  block.z.conservativeResize(Eigen::NoChange, kept);
  block.x.conservativeResize(Eigen::NoChange, kept);
}

MatrixXd first_block(const VectorXd& weights, const MatrixXd& start, Index count) {
  // a problem has no more than unknowns with weight
  const Index columns = std::min<Index>((weights.array() > 0.0).count(), count + 1);
  const Index known = std::min(start.cols(), columns - 1);
  MatrixXd x(weights.size(), columns);
  if (known > 0) x.leftCols(known) = start.leftCols(known);  // an empty start has no rows
  for (Index i = known; i < columns; ++i)
    x.col(i) = pseudo_random(weights.size(), static_cast<unsigned>(i + 1));
  return x;
}

/// The eigenpairs by their distance from zero, the nearest first.
struct Ritz {
  VectorXd values;
  MatrixXd vectors;  ///< columns, shares of the block's motions
};

Ritz ritz_pairs(const VectorXd& weights, const Block& block) {
  // z.J z = z.W x
  const Index k = block.z.cols();
  MatrixXd projected(k, k);
  for (Index i = 0; i < k; ++i)
    for (Index j = 0; j < k; ++j) projected(i, j) = inner(weights, block.z.col(i), block.x.col(j));
  const SymmetricEigen found = symmetric_eigen(symmetric_part(projected));
  std::vector<Index> order(static_cast<std::size_t>(k));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::abs(found.values[a]) < std::abs(found.values[b]); });
  return {found.values(order), found.vectors(Eigen::all, order)};
}

}  // namespace

SoftModes soft_modes(EquilibriumProblem& problem, const MatrixXd& start, Index count, int iterations) {
  const VectorXd& weights = problem.metric();
  Block block{MatrixXd(), first_block(weights, start, count)};
  SoftModes out;
  for (int it = 1; it <= iterations; ++it) {
    block.z.resize(block.x.rows(), block.x.cols());
    for (Index i = 0; i < block.x.cols(); ++i) problem.metric_forces(block.x.col(i), block.z.col(i));
    problem.solve(block.z);
    if (!std::isfinite(block.z.cwiseAbs().sum())) return {};
    orthonormalise(weights, block);
    if (block.z.cols() == 0) return {};  // the tangent stiffness is so singular that no norm is finite
    const Ritz pairs = ritz_pairs(weights, block);
    const Index wanted = it < iterations ? pairs.values.size() : std::min(count, pairs.values.size());
    out.stiffness = pairs.values.head(wanted);
    block.x.setZero(block.z.rows(), wanted);
    for (Index i = 0; i < wanted; ++i)
      for (Index j = 0; j < block.z.cols(); ++j) block.x.col(i) += pairs.vectors(j, i) * block.z.col(j);
  }
  out.motions = std::move(block.x);
  return out;
}

}  // namespace snapthrough
