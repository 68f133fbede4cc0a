#pragma once
/// @file
/// Accuracy of the states of paths at asked load factors.

#include <stop_token>
#include <vector>

#include "solver/accuracy/static_states.h"
#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Writes the error estimate of each state, and replaces those that exceed the accuracy by states of
/// finer meshes (refine_states()), each on its own.
///
/// A state stays as it is, with the warning `state_accuracy`, where a finer mesh has none at its load factor
/// with as many negative eigenvalues, as close to a limit point, or where its estimate still exceeds the
/// accuracy.
/// @param structure structure on the mesh of the unknowns in `states`
/// @param states StaticState::row is the index into Result::states
/// @param stop ends the refinement; states that were not compared have no estimate
void refine_path_states(const Analysis& analysis, const Structure& structure,
                        const std::vector<StaticState>& states, const std::stop_token& stop, Result& result);

}  // namespace snapthrough
