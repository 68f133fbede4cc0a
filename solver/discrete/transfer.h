#pragma once
/// @file
/// The same state on another mesh.

#include <Eigen/Core>

#include "solver/discrete/structure.h"

namespace snapthrough {

/// @brief The unknowns of one structure read off those of another one of the same model.
///
/// Displacements at element ends, their gradients and the stresses at the Gauss points are the values of the
/// other mesh's polynomials there, so going to a finer mesh of nested elements and no lower order changes
/// nothing but the integrals. Linear in `y`: tangents are transferred by it, too.
/// @param y unknowns of `from`, scaled
/// @pre both structures were built from one model and have the same scales
[[nodiscard]] Eigen::VectorXd transfer(const Structure& from, const Eigen::VectorXd& y, const Structure& to);

}  // namespace snapthrough
