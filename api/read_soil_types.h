#pragma once
/// @file
/// Readers of soils whose curves are tables. Internal to api/.

#include "api/soil/layers.h"
#include "api/value.h"

namespace snapthrough::api {

/// @{
/// Reads the parameters of a soil at both faces of its layer: a strength or modulus is one number, or two for
/// the upper and the lower face.
[[nodiscard]] soil::Faces<soil::LayerType> read_soft_clay_matlock(Object& in);
[[nodiscard]] soil::Faces<soil::LayerType> read_stiff_clay(Object& in);
[[nodiscard]] soil::Faces<soil::LayerType> read_stiff_clay_free_water(Object& in);
[[nodiscard]] soil::Faces<soil::LayerType> read_reese_sand(Object& in);
[[nodiscard]] soil::Faces<soil::LayerType> read_pisa_clay(Object& in);
[[nodiscard]] soil::Faces<soil::LayerType> read_pisa_sand(Object& in);
[[nodiscard]] soil::Faces<soil::LayerType> read_weak_rock(Object& in);
[[nodiscard]] soil::Faces<soil::LayerType> read_liquefied_sand(Object& in);
/// @}

/// Reads the axial resistance of a layer. @param has_strength the friction may follow from the layer's `Su`
[[nodiscard]] soil::Axial read_axial(const Value& value, bool has_strength);

}  // namespace snapthrough::api
