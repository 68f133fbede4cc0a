#pragma once
/// @file
/// Pretension of members and springs as strains and shortenings without force.

#include <array>

#include "solver/model/model.h"

namespace snapthrough {

/// @brief Displacement of a spring, along its direction on the undeformed structure, at which it has no
/// force: constant, and per load factor.
///
/// With the length L between its nodes, the length Lu without force and the stiffness k a pretension makes it
/// a shortening by L - Lu, or by force / k; along a direction that points away from the other node it is a
/// lengthening. Spring::lengthening is the opposite of a shortening.
/// @param at, to the nodes at its ends @pre spring.direction is given, along the line between the nodes
[[nodiscard]] std::array<double, 2> displacement_without_force(const Spring& spring, const Node& at,
                                                               const Node& to);

/// @brief Axial strain of a straight bilateral member without force: Lu / L - 1, or -force / EA.
/// @pre member.pretension is given; with a force, EA does not vary
[[nodiscard]] InitialStrain strain_without_force(const Member& member, const Node& start, const Node& end,
                                                 const AlongMember& EA);

}  // namespace snapthrough
