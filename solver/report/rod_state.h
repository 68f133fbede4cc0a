#pragma once
/// @file
/// Results of one-sided members, which the equations have as springs between nodes.

#include <Eigen/Core>
#include <cstddef>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief State of a rod: straight between its nodes, with a constant axial force and no other section force;
/// of a cable cable_state().
/// @param spring index of the spring that stands for the rod
/// @param y, points as for make_state()
[[nodiscard]] MemberState rod_state(const Structure& structure, std::size_t spring, const Eigen::VectorXd& y,
                                    int points);

/// @brief Axial force of a rod over its strength. @pre the rod has a strength
/// @param spring, y as for rod_state()
[[nodiscard]] Utilisation rod_utilisation(const Structure& structure, std::size_t spring,
                                          const Eigen::VectorXd& y);

/// @brief Displacements of a rod in a vector of unknowns, as for mode_displacements(); linear between its
/// nodes, those of a cable too.
[[nodiscard]] MemberMode rod_mode(const Structure& structure, std::size_t spring, const Eigen::VectorXd& mode,
                                  int points);

}  // namespace snapthrough
