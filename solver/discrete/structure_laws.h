#pragma once
/// @file
/// Laws of supports on a mesh.

#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Appends the scaled laws of supports.
/// @param springs, foundations those of Structure::model, or of Structure::laws
/// @pre model, scales, axes, origin, geometry, mesh and nodes of the structure are set
void add_laws(const std::vector<ResolvedSpring>& springs, const std::vector<ResolvedFoundation>& foundations,
              const Structure& structure, std::vector<SpringLaw>& spring_laws,
              std::vector<FoundationLaw>& foundation_laws);

/// Sets Structure::stiffest and Structure::stiffest_rigid. @pre model, scales, axes and mesh are set
void bound_stiffness(Structure& structure);

/// @brief Largest stiffness with which a foundation acts on a member, in the model's units.
/// @pre bound_stiffness() was called
[[nodiscard]] double stiffness_on(const Structure& structure, const ResolvedFoundation& foundation,
                                  int member);

}  // namespace snapthrough
