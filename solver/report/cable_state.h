#pragma once
/// @file
/// Results of cables, which the equations have as catenaries between nodes.

#include <Eigen/Core>
#include <cstddef>

#include "solver/discrete/structure.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief State of a cable at places by its length without force. Its undeformed shape is that in which it
/// hangs between the nodes as they are drawn, under its weight alone.
/// @param spring index of the spring that stands for the cable
/// @param y, points as for make_state()
[[nodiscard]] MemberState cable_state(const Structure& structure, std::size_t spring,
                                      const Eigen::VectorXd& y, int points);

/// @brief Largest axial force of a cable, in the model's units. @param spring, y as for cable_state()
[[nodiscard]] Peak largest_tension(const Structure& structure, std::size_t spring, const Eigen::VectorXd& y);

}  // namespace snapthrough
