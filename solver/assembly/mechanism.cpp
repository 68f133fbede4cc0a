#include "solver/assembly/mechanism.h"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <string>

#include "solver/assembly/structural_problem.h"

namespace snapthrough {
namespace {

/// Displacement (over the structure's length) under forces of the size EI / length^2 that only a mechanism
/// gives.
constexpr double kMechanismDisplacement = 1e11;

/// Forces without pattern on all displacement unknowns: some part of them works on any motion.
Eigen::VectorXd scattered_forces(const Structure& structure) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(structure.size);
  unsigned state = 12345u;
  const auto next = [&state]() {
    state = state * 1664525u + 1013904223u;
    return 0.5 + static_cast<double>(state >> 8) / static_cast<double>(1u << 24);
  };
  for (Eigen::Index i = 0; i < 3 * structure.joints + structure.releases; ++i) forces[i] = next();
  for (const ElementDofs& dofs : structure.dofs)
    for (const int a : dofs.a)
      if (a >= 3 * structure.joints + structure.releases) forces[a] = next();
  for (int j = 0; j < structure.joints; ++j)  // rows of supports prescribe displacements: none
    for (int c = 0; c < 3; ++c)
      if (structure.supports[j].fixed[c]) forces[3 * j + c] = 0.0;
  return forces;
}

}  // namespace

std::vector<Finding> find_mechanism(const Model& model) {
  Model bare = model;
  bare.loads.clear();
  bare.monitors.clear();
  Discretization coarse;
  coarse.fixed_mesh = true;
  coarse.elements = 2;
  coarse.order = 2;
  const Structure structure = make_structure(bare, coarse, Geometry::nonlinear);
  StructuralProblem problem(structure);
  problem.set_bonded(true);
  Eigen::VectorXd residual;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(structure.size);
  problem.linearise(zero, 0.0, residual);
  Eigen::VectorXd x = scattered_forces(structure);
  problem.solve(x);
  double largest = 0.0;
  Eigen::Index worst = 0;
  for (int j = 0; j < structure.joints; ++j) {
    const double size = x.segment<3>(3 * j).lpNorm<Eigen::Infinity>();
    if (size > largest || !std::isfinite(size)) {
      largest = size;
      worst = j;
    }
  }
  for (const ElementDofs& dofs : structure.dofs)
    for (const int a : dofs.a) largest = std::isfinite(x[a]) ? std::max(largest, std::abs(x[a])) : x[a];
  if (largest < kMechanismDisplacement) return {};
  return {{"/model/supports", "mechanism",
           "the structure can move without strain (supports and bases do not hold it; the motion is largest "
           "near node \"" +
               model.nodes[static_cast<std::size_t>(worst)].id + "\")"}};
}

}  // namespace snapthrough
