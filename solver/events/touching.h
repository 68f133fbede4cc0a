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

/// @brief Looks for one-sided supports that touch without pressure from the start of a path on, and for the
/// piece of the tangent that becomes unstable first (set_least_piece()).
///
/// They count as touching when the start's tangent, a linear solution, and the equilibrium at half the least
/// load leave them where they are to 1e-9 of the largest displacement. The start's tangent, which is there
/// anyway, tells whether there are any. Where supports are so stiff that rounding presses them there may be
/// no start without knowing.
/// @param problem of `structure`
/// @param norm with the scales of the start
/// @param start without a point: none was found
/// @return the structure that knows which of them act, to start the path anew; empty: there are none, or no
/// buckling load was found
[[nodiscard]] std::optional<Structure> with_least_piece(const Model& model, const Structure& structure,
                                                        StructuralProblem& problem, const PathNorm& norm,
                                                        const PathStart& start, Result& result);

/// @brief The structure of a finer mesh with the ends of contact of the critical motion that are its own.
/// @param coarse with_least_piece(), or this one
[[nodiscard]] Structure with_finer_piece(const Model& model, const Structure& coarse, Mesh mesh);

/// @brief Warns that the least load over the pieces is not certain.
void warn_of_touching(const Structure& structure, const LeastPiece& piece, Result& result);

}  // namespace snapthrough
