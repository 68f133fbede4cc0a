#pragma once
/// @file
/// The parts of a structure that loads without a potential act on.

#include <Eigen/Core>
#include <vector>

#include "solver/discrete/structure.h"

namespace snapthrough {

/// @brief Forces at the places of the loads without a potential, for each connected part of the structure
/// that has such loads.
///
/// With J = S + L R^T, S symmetric, each column of L and of R is a combination of unit forces and moments at
/// the places of the loads. A motion x of a complex eigenvalue mu is (S - mu M)^-1 L (-R^T x): the Krylov
/// space of these forces contains it, and no motion of a part without such loads. Elements, springs between
/// nodes and semi-rigid joints connect; nodes that are held in every direction do not.
/// @param columns combinations of the unit forces of a part, with pseudo-random factors
/// @return for each part a matrix of size x columns: forces on the unknowns, in global axes
[[nodiscard]] std::vector<Eigen::MatrixXd> follower_parts(const Structure& structure, Eigen::Index columns);

}  // namespace snapthrough
