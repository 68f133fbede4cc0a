#include "solver/trace/bifurcations_ahead.h"

#include <cmath>

#include "solver/events/hidden_events.h"
#include "solver/events/newton_event.h"

namespace snapthrough {
namespace {

/// Numbers of the look ahead; ratios without unit.
struct LookAhead {
  static constexpr double steps = 1.5;  ///< distance of a bifurcation that is looked for, over the step
  static constexpr double reach = 2.0;  ///< farthest from its prediction, over the step
  static constexpr double close = 1.5;  ///< distance of others that are found with it, over its own
  static constexpr double most_along =
      0.5;  ///< cosine of the tangent and the motion: at a limit point it is 1
};

/// The bifurcations beyond a point where a motion loses (or regains) its stiffness, with all that do so close
/// by.
std::vector<CriticalEvent> bifurcations_of(PointSolver& solver, const PathPoint& from, Eigen::Index first,
                                           double reach, const BifurcationBounds& bounds) {
  const SoftModes& modes = *from.modes;
  const double distance = modes.distance_to_zero(first, 1.0);
  std::vector<Eigen::Index> close;
  for (Eigen::Index i = 0; i < modes.count(); ++i) {
    const bool same_sign = (modes.stiffness[i] > 0.0) == (modes.stiffness[first] > 0.0);
    if (same_sign && modes.distance_to_zero(i, 1.0) <= LookAhead::close * distance) close.push_back(i);
  }
  auto events = bifurcations_beyond(solver, from, close, distance, reach, bounds.tolerance);
  if (!events.empty() && events.front().imperfection > bounds.most_broken) events.clear();
  return events;
}

}  // namespace

std::vector<CriticalEvent> predicted_bifurcations(PointSolver& solver, const PathPoint& from, double wanted,
                                                  const BifurcationBounds& bounds) {
  // a motion that is pinned at the start may turn out to be resisted
  if (!from.modes || (from.context.holds && from.arc_length == 0.0)) return {};
  const SoftModes& modes = *from.modes;
  Eigen::Index first = 0;
  for (Eigen::Index i = 1; i < modes.count(); ++i)
    if (modes.distance_to_zero(i, 1.0) < modes.distance_to_zero(first, 1.0)) first = i;
  if (!(modes.distance_to_zero(first, 1.0) < LookAhead::steps * wanted)) return {};
  const double along = solver.norm().metric().inner(from.tangent, 0.0, modes.motions.col(first), 0.0);
  if (std::abs(along) > LookAhead::most_along) return {};
  return bifurcations_of(solver, from, first, LookAhead::reach * wanted, bounds);
}

std::vector<CriticalEvent> bifurcations_stepped_over(PointSolver& solver, const PathPoint& from,
                                                     const PathPoint& to, const BifurcationBounds& bounds) {
  const double length = solver.norm().distance(from, to);
  const auto dip = find_dip(from, to, length);
  if (from.negative != to.negative || !dip) return {};
  return bifurcations_of(solver, from, dip->mode, length, bounds);
}

}  // namespace snapthrough
