#pragma once
/// @file
/// Initial axes of a model's members.

#include <memory>
#include <vector>

#include "solver/geometry/axis_curve.h"
#include "solver/model/id_index.h"
#include "solver/model/model.h"

namespace snapthrough {

/// Axes of all members in the model's units, relative to the first node.
using Axes = std::vector<std::shared_ptr<const AxisCurve>>;
[[nodiscard]] Axes make_axes(const Model& model);
/// @brief Axis of one member, as in make_axes().
/// @param nodes index of the model's nodes
[[nodiscard]] AxisCurve axis_of(const Model& model, const IdIndex& nodes, const Member& member);

}  // namespace snapthrough
