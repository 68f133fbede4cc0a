#include "solver/accuracy/polish.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/discrete/transfer.h"
#include "solver/events/flutter.h"
#include "solver/events/locate.h"
#include "solver/events/newton_event.h"
#include "solver/path/segment.h"

namespace snapthrough {
namespace {

PathOptions patient(PathOptions options) {
  options.corrector.max_iterations = PolishLimits::corrections;
  options.corrector.most_stalled = PolishLimits::corrections;
  return options;
}

/// The found point that matches the known type and inertia; the nearest by load if several match.
std::optional<FoundPoint> same_as(const CriticalEvent& known, const std::vector<CriticalEvent>& found) {
  const CriticalEvent* best = nullptr;
  for (const CriticalEvent& event : found) {
    if (event.type != known.type || event.negative_before != known.negative_before ||
        event.negative_after != known.negative_after)
      continue;
    const double distance = std::abs(event.point.lambda - known.point.lambda);
    if (!best || distance < std::abs(best->point.lambda - known.point.lambda)) best = &event;
  }
  if (best == nullptr) return std::nullopt;
  return FoundPoint{*best, best->point};
}

}  // namespace

FineMesh::FineMesh(Structure structure, const PathFollower& measure, double tolerance)
    : structure_(std::move(structure)),
      problem_(structure_),
      follower_(problem_, patient(measure.options())),
      tolerance_(tolerance) {
  follower_.norm().adopt(measure.norm());
}

PathPoint FineMesh::transferred(const Structure& from, const PathPoint& point,
                                Eigen::MatrixXd& motions) const {
  const Eigen::Index count = motions.cols();
  Eigen::MatrixXd all(point.y.size(), 2 + count);
  all.col(0) = point.y;
  all.col(1) = point.tangent;
  if (count > 0) all.rightCols(count) = motions;
  all = transfer(from, all, structure_);
  PathPoint out = point;
  out.y = all.col(0);
  out.tangent = all.col(1);
  motions = all.rightCols(count);
  const double norm = follower_.norm().metric().norm(out.tangent, out.tangent_lambda);
  out.tangent /= norm;
  out.tangent_lambda /= norm;
  return out;
}

/// Path point in the plane normal to the tangent of `guess`, at the distance along * reach, |along| <= 1.
std::optional<PathPoint> FineMesh::corrected(const PathPoint& guess, double along, double reach) {
  PathPoint lo = guess;
  PathPoint hi = guess;
  lo.y -= reach * guess.tangent;
  lo.lambda -= reach * guess.tangent_lambda;
  lo.arc_length -= reach;
  hi.y += reach * guess.tangent;
  hi.lambda += reach * guess.tangent_lambda;
  hi.arc_length += reach;
  const Segment around(follower_.solver(), lo, hi, guess.tangent, guess.tangent_lambda);
  return around.point_at(0.5 * (1.0 + along));
}

std::optional<FoundPoint> FineMesh::near(const CriticalEvent& known, const PathPoint& at, double reach) {
  const auto before = corrected(at, -1.0, reach);
  if (!before) return std::nullopt;
  const auto after = corrected(at, 1.0, reach);
  if (!after) return std::nullopt;
  const LocatedEvents located = locate_critical_points(follower_.solver(), *before, *after, {tolerance_});
  if (!located.same_path) return std::nullopt;
  return same_as(known, located.events);
}

/// The point of the same kind, within a distance of a point, from which on vibrations grow.
std::optional<FoundPoint> FineMesh::growth_near(const CriticalEvent& known, const PathPoint& at,
                                                double reach) {
  const auto before = corrected(at, -1.0, reach);
  const auto after = corrected(at, 1.0, reach);
  if (!before || !after) return std::nullopt;
  const auto event = FlutterSearch(structure_).on_step(follower_.solver(), *before, *after, tolerance_).loss;
  if (!event || event->type != known.type || event->cause != known.cause) return std::nullopt;
  return FoundPoint{*event, event->point};
}

std::optional<FoundPoint> FineMesh::follow(const CriticalEvent& known, const PathPoint& before,
                                           double distance) {
  auto from = corrected(before, 0.0, distance);
  if (!from) return std::nullopt;
  StepSize size{0.0, distance};
  PathPoint to;
  for (int n = 0; n < PolishLimits::steps; ++n) {
    const StepOutcome outcome = follower_.step(*from, size, to);
    if (outcome == StepOutcome::step_underflow) return std::nullopt;
    const LocatedEvents located = outcome == StepOutcome::kinked
                                      ? locate_at_kink(follower_, *from, to, size.taken, {tolerance_})
                                      : locate_critical_points(follower_.solver(), *from, to, {tolerance_});
    if (!located.same_path) {
      follower_.reject(size);
      continue;
    }
    if (auto found = same_as(known, located.events)) return found;
    std::swap(*from, to);
  }
  return std::nullopt;
}

bool FineMesh::has(const Structure& from, const PathPoint& point) {
  Eigen::MatrixXd none;
  const PathPoint at = transferred(from, point, none);
  const double reach = PolishLimits::reach * follower_.norm().metric().norm(at.y, 0.0);
  if (!(reach > 0.0)) return true;  // no displacement yet
  const auto found = corrected(at, 0.0, reach);
  return found && found->negative == point.negative && follower_.norm().distance(*found, at) <= reach;
}

std::optional<CriticalEvent> FineMesh::by_newton(const CriticalEvent& known, const PathPoint& at,
                                                 Eigen::MatrixXd null) {
  const double reach = PolishLimits::reach * PolishLimits::widening * follower_.norm().search_scale(at);
  return critical_point_near(follower_.solver(), known, at, std::move(null), reach, tolerance_);
}

std::optional<CriticalEvent> FineMesh::bifurcation(const Structure& from, const CriticalEvent& known) {
  Eigen::MatrixXd null = known.null;
  const PathPoint at = transferred(from, known.point, null);
  return by_newton(known, at, std::move(null));
}

std::optional<FoundPoint> FineMesh::find(const Structure& from, const CriticalEvent& known,
                                         const Structure& base, const PathPoint& before) {
  Eigen::MatrixXd null = known.null;
  const PathPoint at = transferred(from, known.point, null);
  const double path = follower_.norm().search_scale(at);
  if (!(path > 0.0)) return std::nullopt;
  if (grows_from(known)) {
    if (auto found = growth_near(known, at, PolishLimits::reach * path)) return found;
    return growth_near(known, at, PolishLimits::reach * PolishLimits::widening * path);
  }
  if (known.null.size() > 0)
    if (const auto event = by_newton(known, at, null)) return FoundPoint{*event, event->point};
  if (known.type == CriticalType::broken_bifurcation) return std::nullopt;
  for (const double reach : {PolishLimits::reach * path, PolishLimits::reach * PolishLimits::widening * path})
    if (auto found = near(known, at, reach)) return found;
  Eigen::MatrixXd none;
  const PathPoint start = transferred(base, before, none);
  return follow(known, start, follower_.norm().distance(start, at));
}

}  // namespace snapthrough
