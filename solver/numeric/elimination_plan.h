#pragma once
/// @file
/// Elimination order of a sparse symmetric matrix.

#include <span>
#include <vector>

namespace snapthrough {

/// Unknowns that are eliminated together.
struct FrontPlan {
  /// Number of unknowns up to which one dense front is faster than many small ones.
  static constexpr int one_dense = 64;

  std::vector<int> pivots;    ///< unknowns that are eliminated in this front
  std::vector<int> rest;      ///< unknowns that are coupled with the pivots
  std::vector<int> blocks;    ///< blocks of the matrix that are assembled here
  std::vector<int> children;  ///< fronts whose rest is assembled here; they precede this one
};

/// @brief Plans fronts in elimination order, kept small by approximate minimum degree.
///
/// Unknowns of a single block are eliminated with the first of the block's other unknowns. Member end forces,
/// whose diagonal may be zero, thus join the displacements that provide their pivots. A small matrix is one
/// front in the order of its unknowns.
/// @param size number of unknowns
/// @param blocks unknowns of each block of the matrix; negative entries are ignored
[[nodiscard]] std::vector<FrontPlan> plan_elimination(int size, std::span<const std::vector<int>> blocks);

}  // namespace snapthrough
