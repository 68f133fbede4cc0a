#pragma once
/// @file
/// Reader of the surface of a medium, for drawings.

#include <memory>

#include "api/plot/document.h"
#include "solver/support/surface.h"

namespace snapthrough::api::plot {

/// @brief Surface of a model's `outline`, in the model's coordinates.
/// @throws PlotError naming the field
[[nodiscard]] std::shared_ptr<const Surface> read_outline(const Field& field);

}  // namespace snapthrough::api::plot
