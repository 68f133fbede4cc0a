#pragma once
/// @file
/// Places at which stops act: rigid one-sided springs along a direction, whose forces are unknowns.

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Whether a spring is a stop along a direction. A rotational stop acts on one unknown, as a stiff spring.
[[nodiscard]] bool is_stop(const ResolvedSpring& spring);

/// @brief Node at which a stop acts; -1: inside an element.
/// @pre mesh, Structure::stop_elements and Structure::first_stop_node are set
[[nodiscard]] int node_of_stop(const Structure& structure, const ResolvedSpring& stop);

/// Sets Structure::first_ground, first_stop_node, stop_elements, parts_between_nodes and nodes.
/// @pre the mesh is set
void number_nodes(Structure& structure);

}  // namespace snapthrough
