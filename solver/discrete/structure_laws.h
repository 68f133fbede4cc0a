#pragma once
/// @file
/// Laws of supports on a mesh.

#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Appends the scaled laws of a model's supports.
/// @param members model whose members they support; @param supports the same model, or one with joined
/// supports
/// @pre scales, axes, origin, geometry, mesh and nodes of the structure are set
void add_laws(const ResolvedModel& members, const ResolvedModel& supports, const Structure& structure,
              std::vector<FoundationLaw>& foundations, std::vector<SpringLaw>& springs);

/// Sets Structure::stiffest and Structure::stiffest_rigid. @pre scales, axes and mesh are set
void bound_stiffness(const ResolvedModel& model, Structure& structure);

/// @brief Largest stiffness with which a foundation acts on a member, in the model's units.
/// @pre bound_stiffness() was called
[[nodiscard]] double stiffness_on(const Structure& structure, const ResolvedFoundation& foundation,
                                  int member);

}  // namespace snapthrough
