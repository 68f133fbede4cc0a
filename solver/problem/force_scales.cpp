#include "solver/problem/force_scales.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/discrete/least_euler_load.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Axial force over the largest, below which last_critical_load() ignores a member. Chosen.
constexpr double kSmallAxialForce = 1e-2;

/// Displacement gradient of the initial strains and prescribed displacements of a load pattern: the largest
/// of strain, curvature times member length, and displacement over the structure's length.
/// @param load vector of the pattern; its initial strains are in the rows of section forces
double imposed_gradient(const Structure& structure, const VectorXd& load,
                        std::array<double, 3> NodeSupport::*displacement) {
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const int p = rule.order();
  double gradient = 0.0;
  for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
    const double element = length_of_element(structure, static_cast<int>(e));
    const std::size_t member = structure.mesh.elements[e].member;
    const double length = structure.axes[member]->length() / structure.scales.length;
    for (int q = 0; q < p; ++q) {
      const double weight = element * rule.weight(q);
      const Index row = structure.dofs[e].s + q;
      gradient =
          std::max({gradient, std::abs(load[row]) / weight, length * std::abs(load[row + 2 * p]) / weight});
    }
  }
  for (const NodeSupport& support : structure.supports)
    for (const double value : support.*displacement) gradient = std::max(gradient, std::abs(value));
  return gradient;
}

}  // namespace

ForceScales::ForceScales(const Structure& structure, ElementWork& elements) : structure_(structure) {
  loads_ = {of_loads(elements, {1.0, 0.0}), of_loads(elements, {0.0, 1.0})};
  const double softest = least_euler_load(structure);
  imposed_ = {softest * imposed_gradient(structure, structure.proportional_load, &NodeSupport::proportional),
              softest * imposed_gradient(structure, structure.constant_load, &NodeSupport::constant)};
}

/// Largest residual among the rows of forces and moments; the other rows are displacements and strains.
double ForceScales::of_rows(const VectorXd& f) const {
  double forces = f.head(DofMap::count(structure_.nodes) + structure_.releases).lpNorm<Eigen::Infinity>();
  for (const ElementDofs& dofs : structure_.dofs) {
    forces =
        std::max(forces, f.segment(dofs.v, DofMap::count(structure_.mesh.order)).lpNorm<Eigen::Infinity>());
    for (const int a : dofs.a) forces = std::max(forces, std::abs(f[a]));
  }
  return forces;
}

/// Largest force or moment of the loads with given factors on the undeformed structure.
double ForceScales::of_loads(ElementWork& elements, const LoadFactors& factors) const {
  VectorXd load =
      factors.proportional * structure_.proportional_load + factors.constant * structure_.constant_load;
  elements.add_pressure_load(VectorXd::Zero(structure_.size), factors,
                             structure_.geometry == Geometry::linear, load);
  return of_rows(load);
}

double ForceScales::imposed(const LoadFactors& factors) const {
  return std::abs(factors.proportional) * imposed_.proportional +
         std::abs(factors.constant) * imposed_.constant;
}

double ForceScales::largest(const VectorXd& y, const LoadFactors& factors) const {
  double force = std::max(std::abs(factors.proportional) * loads_.proportional,
                          std::abs(factors.constant) * loads_.constant);
  for (const ElementDofs& dofs : structure_.dofs)
    force = std::max(force, y.segment<3>(dofs.m).lpNorm<Eigen::Infinity>());
  return force;
}

double ForceScales::reference(const VectorXd& y, const LoadFactors& factors) const {
  return std::max(largest(y, factors), imposed(factors));
}

double ForceScales::least(const LoadFactors& factors) const { return Rounding::force * imposed(factors); }

double ForceScales::relative(const VectorXd& f, const VectorXd& y, const LoadFactors& factors) const {
  const int strains = DofMap::count(structure_.mesh.order);
  const double force = reference(y, factors);
  double displacement = 1.0;
  const double forces = of_rows(f);
  double gaps = 0.0;
  for (const ElementDofs& dofs : structure_.dofs) {
    gaps = std::max(gaps, f.segment(dofs.s, strains + DofMap::components).lpNorm<Eigen::Infinity>());
    for (const int a : dofs.a) displacement = std::max(displacement, std::abs(y[a]));
  }
  for (int i = structure_.before_elements() - structure_.stops; i < structure_.before_elements(); ++i)
    gaps = std::max(gaps, std::abs(f[i]));
  return std::max(force > 0.0 ? forces / force : forces, gaps / displacement);
}

double ForceScales::largest_axial(std::size_t member, const VectorXd& response) const {
  double force = 0.0;
  for (int e = structure_.mesh.first[member]; e < structure_.mesh.first[member + 1]; ++e)
    for (int q = 0; q < structure_.mesh.order; ++q)
      force = std::max(force, std::abs(response[structure_.dofs[e].s + q]));
  return force;
}

double ForceScales::first_critical_load(const VectorXd& response, const LoadFactors& factors) const {
  double scale = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < structure_.euler_loads.size(); ++m) {
    const double force = largest_axial(m, response);
    if (force > least(factors)) scale = std::min(scale, structure_.euler_loads[m] / force);
  }
  return scale;
}

double ForceScales::last_critical_load(const VectorXd& response, const LoadFactors& factors) const {
  double largest = 0.0;
  for (std::size_t m = 0; m < structure_.euler_loads.size(); ++m)
    largest = std::max(largest, largest_axial(m, response));
  double scale = 0.0;
  for (std::size_t m = 0; m < structure_.euler_loads.size(); ++m) {
    const double force = largest_axial(m, response);
    if (force > std::max(kSmallAxialForce * largest, least(factors)))
      scale = std::max(scale, (structure_.euler_loads[m] + structure_.foundation_loads[m]) / force);
  }
  return scale;
}

}  // namespace snapthrough
