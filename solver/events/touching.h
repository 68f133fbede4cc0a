#pragma once
/// @file
/// Paths on which one-sided supports touch without pressure.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/events/least_piece.h"
#include "solver/path/path_start.h"
#include "solver/problem/structural_problem.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Finds one-sided supports that touch without pressure from the start of a path, and the combination
/// of them that becomes unstable first (set_least_piece()).
///
/// A support touches when the tangent at the start and the equilibrium at half the least buckling load both
/// leave it in place to 1e-9 of the largest displacement. If supports are so stiff that only rounding presses
/// them, the path may have no start before this is known.
/// @param problem problem of `structure`
/// @param problem of `structure`
/// @param norm with the scales of the start
/// @param start without a point: none was found
/// @return structure with the state of the touching supports, to start the path anew; empty when no support
/// touches, or no buckling load was found
[[nodiscard]] std::optional<Structure> with_least_piece(const Structure& structure,
                                                        StructuralProblem& problem, const PathNorm& norm,
                                                        const PathStart& start, Result& result);

/// @brief Structure on a finer mesh, with the contact ends of the critical motion computed on that mesh.
/// @param coarse structure of with_least_piece(), or of this function
[[nodiscard]] Structure with_finer_piece(const Structure& coarse, Mesh mesh);

/// @brief Adds a warning to the result when the least load over the pieces is not proven.
void warn_of_touching(const Structure& structure, const LeastPiece& piece, Result& result);

}  // namespace snapthrough
