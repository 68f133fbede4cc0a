#pragma once
/// @file
/// Transfer of states to another mesh.

#include <Eigen/Core>

#include "solver/discrete/structure.h"

namespace snapthrough {

/// @brief Evaluates states of one structure at the unknowns of another structure of the same model.
///
/// Displacements at element ends, their gradients and the section forces at Gauss points are evaluated from
/// the polynomials of the first mesh. On a nested finer mesh of no lower order only the integrals change. The
/// transfer is linear in `y` and therefore also applies to tangents.
/// @param y unknowns of `from`, scaled; each column is a state or a tangent
/// @pre both structures were built from one model and have the same scales
[[nodiscard]] Eigen::MatrixXd transfer(const Structure& from, const Eigen::Ref<const Eigen::MatrixXd>& y,
                                       const Structure& to);

}  // namespace snapthrough
