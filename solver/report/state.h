#pragma once
/// @file
/// Reported states of a structure: shape, section forces, reactions, contact.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Shapes and section forces at `points` equally spaced places of each member.
/// @param y, lambda as for make_state() @pre points >= 2
[[nodiscard]] std::vector<MemberState> member_states(const Structure& structure, const Eigen::VectorXd& y,
                                                     double lambda, int points);

/// @brief Makes the reported state: members and foundations at `points` equally spaced places, and the forces
/// of supports, springs, foundations and loads on the structure. Branch and refinements are 0.
/// @param output number of points, and places whose tangent stiffness is part of the state
/// @param y scaled unknowns of the structure's problem; the result is in the model's units
/// @param lambda scaled load factor of the state
/// @pre output.points_per_member >= 2
[[nodiscard]] State make_state(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                               const OutputOptions& output);

/// @brief What is left of the sum of all actions and reactions in a state, over the largest force and the
/// largest moment among them. The reactions are those that make_state() reports.
/// @param y, lambda as for make_state()
[[nodiscard]] double imbalance(const Structure& structure, const Eigen::VectorXd& y, double lambda);

/// Sentence on a state that is not reported because of its imbalance().
[[nodiscard]] std::string imbalance_text(double load_factor, double left);

/// @brief Fraction of each foundation's range in contact; 1 for bilateral foundations.
[[nodiscard]] std::vector<double> contact_fractions(const Structure& structure, const Eigen::VectorXd& y);

}  // namespace snapthrough
