#pragma once
/// @file
/// Structures of models on meshes.

#include "solver/discrete/structure.h"
#include "solver/geometry/stress_free_axis.h"
#include "solver/mesh/mesh.h"
#include "solver/model/analysis.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Builds the structure of a model.
/// @pre the model passed the reference and range checks of check()
[[nodiscard]] Structure make_structure(ResolvedModel model, const Discretization& discretization,
                                       Geometry geometry, const ModeOffsets& modes = {},
                                       MeshUse use = MeshUse::final);
/// @brief Builds the structure of the same model, imperfections and scales on another mesh.
[[nodiscard]] Structure on_mesh(const Structure& structure, Mesh mesh);
/// @brief Builds the same structure with a known state of the supports that touch without pressure.
[[nodiscard]] Structure with_touching(const Structure& structure, TouchingSupports touching);

/// @brief Builds the structure of a changed model with the same members. Unknowns, elements and scales
/// remain, so that a state vector has the same meaning in both. Axes, element shapes, contact samples and
/// load vectors are taken over where what they follow from is the same in both models.
/// @param modes offsets of the changed model's mode imperfections
/// @pre the changed model passed check()
[[nodiscard]] Structure with_changed_model(const Structure& structure, ResolvedModel changed,
                                           const ModeOffsets& modes);

}  // namespace snapthrough
