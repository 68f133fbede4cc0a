#pragma once
/// @file
/// Masses of a structure on its mesh.

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/element/element_masses.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Parts of M on the values (u_a, u'_1, ..., u'_p) of one component of an element, (p + 1) x (p + 1): x and y
/// have the same, the rotation has another. Empty where there is no mass.
struct MassBlocks {
  Eigen::MatrixXd moving, turning;
};

/// Mass matrix M of a structure. Eigenvalues mu of J x = mu M x are squares of circular frequencies.
struct MassMatrix {
  ElementMasses elements;
  std::vector<MassBlocks> blocks;  ///< one for each element
  double square = 1.0;             ///< omega^2 of mu = 1, in the model's units
  /// Estimate of the lowest mu of a member alone: pi^4 EI / (m l^4), least over the members.
  double scale = 1.0;
  /// Number of independent motions that move mass: where places alone are heavy, those of the places; else
  /// the number of unknowns.
  Eigen::Index rank = 0;
};

/// Whether a section has a mass per length that is not zero.
[[nodiscard]] bool is_heavy(const Section& section);

/// Whether any section or place has a mass that is not zero.
/// @param model a Model or a ResolvedModel
template <class AnyModel>
[[nodiscard]] bool has_mass(const AnyModel& model) {
  const auto point = [](const PointMass& one) { return one.mass > 0.0 || one.inertia > 0.0; };
  return std::any_of(model.sections.begin(), model.sections.end(), is_heavy) ||
         std::any_of(model.masses.begin(), model.masses.end(), point);
}

/// @brief Masses of sections, integrated over the elements exactly for sections that do not taper, and point
/// masses.
/// @pre structure.traits.has_mass
[[nodiscard]] MassMatrix make_mass_matrix(const Structure& structure);

/// @brief M times each column of `motions`: forces on the unknowns of the elements, in global axes.
[[nodiscard]] Eigen::MatrixXd mass_products(const Structure& structure, const MassMatrix& masses,
                                            const Eigen::Ref<const Eigen::MatrixXd>& motions);

}  // namespace snapthrough
