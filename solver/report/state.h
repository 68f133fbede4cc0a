#pragma once
/// @file
/// What a state of a structure looks like: shape, section forces, reactions, contact.

#include <Eigen/Core>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Shapes and section forces at `points` equally spaced places of each member.
/// @param y, lambda, points as for make_state()
[[nodiscard]] std::vector<MemberState> member_states(const Structure& structure, const Model& model,
                                                     const Eigen::VectorXd& y, double lambda, int points);

/// @brief Everything a state says: members and foundations sampled at `points` equally spaced places, and
/// what supports, springs, foundations and loads put on the structure. Its branch is 0, its refinements 0.
/// @param y unknowns of the structure's problem (scaled units); the result is in the model's units
/// @param lambda scaled load factor of that state
/// @pre points >= 2
[[nodiscard]] State make_state(const Structure& structure, const Model& model, const Eigen::VectorXd& y,
                               double lambda, int points);

/// @brief Share of each foundation's range that is in contact; 1 for a bilateral one.
[[nodiscard]] std::vector<double> contact_fractions(const Structure& structure, const Model& model,
                                                    const Eigen::VectorXd& y);

}  // namespace snapthrough
