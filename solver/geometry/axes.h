#pragma once
/// @file
/// Initial axes of a model's members.

#include <memory>
#include <vector>

#include "solver/geometry/axis_curve.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Axes of all members in the model's units, relative to the first node.
using Axes = std::vector<std::shared_ptr<const AxisCurve>>;
[[nodiscard]] Axes make_axes(const ResolvedModel& model);
/// Axis of one member, as in make_axes().
[[nodiscard]] AxisCurve axis_of(const ResolvedModel& model, const ResolvedMember& member);
/// Axis of a curve from node `a` to node `b`, relative to the node `origin`.
[[nodiscard]] AxisCurve axis_of(const Curve& curve, const Node& origin, const Node& a, const Node& b);

}  // namespace snapthrough
