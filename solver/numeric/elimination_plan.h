#pragma once
/// @file
/// In which order the unknowns of a sparse symmetric matrix are eliminated.

#include <span>
#include <vector>

namespace snapthrough {

/// Unknowns that are eliminated together.
struct FrontPlan {
  std::vector<int> pivots;    ///< eliminated here
  std::vector<int> rest;      ///< what they are coupled with then
  std::vector<int> blocks;    ///< of the matrix: those that are added here
  std::vector<int> children;  ///< fronts whose rest is added here; all before this one
};

/// @brief Fronts in the order of their elimination, which keeps them small (approximate minimum degree).
///
/// Unknowns of one block only are eliminated with the first of the block's other unknowns. So the forces at a
/// member's ends, whose own rows may have no pivot, meet the displacements that they need. A small matrix is
/// one front, in the order of the unknowns.
/// @param size how many unknowns there are
/// @param blocks unknowns of each block of the matrix; negative ones are none
[[nodiscard]] std::vector<FrontPlan> plan_elimination(int size, std::span<const std::vector<int>> blocks);

}  // namespace snapthrough
