#pragma once
/// @file
/// A critical point as the result lists it.

#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief What a located critical point says by itself: kind, counts, and what set_values() sets. Branch,
/// error estimate, state, mode, member and meshes are left to the analysis.
[[nodiscard]] CriticalPoint critical_point(const Structure& structure, const CriticalEvent& event);

/// Sets the values that differ from mesh to mesh: load factor and monitors, in the units of the model.
/// @param structure the mesh that the event was located on
void set_values(const Structure& structure, const CriticalEvent& event, CriticalPoint& point);

}  // namespace snapthrough
