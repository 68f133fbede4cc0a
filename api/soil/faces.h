#pragma once
/// @file
/// Parameters of soil between the faces of its layer.

#include <optional>

#include "api/soil/layers.h"

namespace snapthrough::api::soil {

/// @{
/// @brief Returns the parameters at a fraction of the thickness, 0 at the upper face.
///
/// Strengths, moduli and frictions are linear between the faces; the others are those of the upper face.
[[nodiscard]] LayerType at(const Faces<LayerType>& faces, double fraction);
[[nodiscard]] AxialType at(const Faces<AxialType>& faces, double fraction);
/// @}

/// Returns the part of a layer between fractions of its thickness: its soil, its axial and its end
/// resistance.
[[nodiscard]] Layer part_of(const Layer& layer, double from, double to);

/// Returns the undrained shear strength at a fraction of the thickness; nullopt for soil that has none.
[[nodiscard]] std::optional<double> strength_at(const Layer& layer, double fraction);

/// Returns clay whose formula needs the mean strength from the surface with that mean, and other soil as it
/// is.
[[nodiscard]] LayerType with_mean_strength(LayerType type, double mean);

}  // namespace snapthrough::api::soil
