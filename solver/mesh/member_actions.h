#pragma once
/// @file
/// What the mesh of a member depends on, collected for all members in one pass over the model.

#include <vector>

#include "solver/geometry/axis_curve.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// What acts on one member, as far as its mesh depends on it.
struct MemberActions {
  std::vector<double> places;  ///< fractions at which elements must end, without order, with 0 and 1
  std::vector<const Foundation*> foundations;
  const Section* section = nullptr;
  /// Elements of the whole member that its imperfections need at least: two for each half-wave of a sine, one
  /// for each interval of a spline. (A coarser mesh has another imperfection, and its path may turn to the
  /// other side.)
  double imperfection_elements = 0.0;
};

/// @brief Actions on each member of a model, in their order.
/// @pre check() found nothing; the model outlives the result
[[nodiscard]] std::vector<MemberActions> actions_on_members(const ResolvedModel& model);

/// @brief Fractions at which elements of a member must end, ascending, with 0 and 1: the places of its
/// actions and the knots of its axis.
[[nodiscard]] std::vector<double> breaks_of(const MemberActions& actions, const AxisCurve& axis);

}  // namespace snapthrough
