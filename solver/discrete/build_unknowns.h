#pragma once
/// @file
/// Places of the unknowns of a structure.

#include <vector>

#include "solver/discrete/structure.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Numbers the unknowns: those of the nodes, released rotations, forces of stops, then those of each
/// element with the node that ends it. Sets the joints, and load vectors of zeros.
/// @param equations laws of the springs of `out.laws`, whose stops get their unknowns
/// @pre the model, mesh, scales, nodes and laws of `out` are set
void number_unknowns(std::vector<SpringLaw>& equations, Structure& out);

}  // namespace snapthrough
