#pragma once
/// @file
/// How near to where something acts on a member its bending changes.

#include <Eigen/Core>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief The shortest length over which a state's bending decays from the places where something acts on a
/// member, in the model's units; infinite where nothing shortens it.
///
/// Under tension N bending decays as exp(-s sqrt(N / EI)), on a base of modulus K that shear reaches first as
/// exp(-s sqrt(K / GA)). In thin members that is far less than any length that is known before the path.
[[nodiscard]] std::vector<double> bending_decays(const Structure& structure, const Model& model,
                                                 const Eigen::VectorXd& y);

}  // namespace snapthrough
