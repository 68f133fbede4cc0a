#pragma once
/// @file
/// Largest stress over strength of a structure in a state.

#include <Eigen/Core>
#include <optional>
#include <string>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Utilisation of a member in a state.
struct MemberUtilisation {
  std::string member;  ///< id
  Utilisation place;
};

/// Whether a section that a member has is given a strength.
[[nodiscard]] bool has_strength(const ResolvedModel& model);

/// @brief Largest stress over strength in a state; empty: no member has a strength. From half of the strength
/// on it is the largest along the members, below that the largest at the middles and ends of elements.
/// @param y scaled unknowns, in equilibrium with the scaled load factor lambda
[[nodiscard]] std::optional<MemberUtilisation> largest_utilisation(const Structure& structure,
                                                                   const Eigen::VectorXd& y, double lambda);

}  // namespace snapthrough
