#pragma once
/// @file
/// Pretension of members and springs as strains and shortenings without force.

#include "solver/model/model.h"

namespace snapthrough {

/// @brief Displacement of a spring, along its direction on the undeformed structure, at which it has no
/// force.
///
/// With the length L between its nodes, the length Lu without force and the stiffness k it is a shortening by
/// L - Lu, or by force / k; along a direction that points away from the other node it is a lengthening.
/// @param at, to the nodes at its ends @pre spring.pretension and spring.direction are given, and the
/// direction is along the line between the nodes
[[nodiscard]] double displacement_without_force(const Spring& spring, const Node& at, const Node& to);

/// @brief Axial strain of a straight bilateral member without force: Lu / L - 1, or -force / EA.
/// @pre member.pretension is given; with a force, EA does not vary
[[nodiscard]] InitialStrain strain_without_force(const Member& member, const Node& start, const Node& end,
                                                 const AlongMember& EA);

}  // namespace snapthrough
