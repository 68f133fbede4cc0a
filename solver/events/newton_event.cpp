#include "solver/events/newton_event.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/events/critical_system.h"
#include "solver/numeric/cubic.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Events by Newton's method; ratios. Source: docs/decisions/0010 and 0022.
struct NewtonEventLimits {
  /// Displacement tolerance over the reach where only the load (error of second order) is reported.
  static constexpr double place_without_state = 1e-3;
  static constexpr double same_way = 0.5;  ///< least cosine of the path and its tangent at an event
  static constexpr double exact = 1e-5;    ///< load distance whose square is negligible
  static constexpr double close = 1e-2;    ///< load distance up to which bifurcations are neighbours
  static constexpr double beside = 1e-2;   ///< distance of the inertia counts from an event, over the reach
  static constexpr double same_motion = 0.9;  ///< least cosine of the motions of both ends that are one
};

CriticalOptions options_for(const PointSolver& solver, double tolerance, double reach) {
  CriticalOptions options;
  if (solver.options().tangent_tolerance > 0.0) {
    options.place = NewtonEventLimits::place_without_state;
    options.to_rounding = false;
  }
  options.tolerance = 0.1 * tolerance;
  options.least_load = solver.norm().least_load();
  options.reach = reach;
  return options;
}

/// Tangents of the followed path and of the crossing path at a bifurcation.
struct Tangents {
  CriticalDirection along;
  CriticalDirection across;  ///< direction of the crossing path; y is empty when unknown
};

std::optional<Tangents> tangents_along(const PathMetric& metric, const CriticalSolution& found,
                                       const PathDirection& way) {
  const auto inner = [&](const CriticalDirection& d) {
    return metric.inner(d.y, d.lambda, way.y, way.lambda);
  };
  auto all = found.tangents(metric);
  if (all.empty()) return std::nullopt;
  if (all.size() == 2 && std::abs(inner(all[1])) > std::abs(inner(all[0]))) std::swap(all[0], all[1]);
  const double along = inner(all[0]);
  if (!(std::abs(along) >= NewtonEventLimits::same_way * metric.norm(way.y, way.lambda))) return std::nullopt;
  Tangents out{std::move(all[0]), all.size() == 2 ? std::move(all[1]) : CriticalDirection{}};
  if (along < 0.0) out.along = {-out.along.y, -out.along.lambda, -out.along.stiffness_rate};
  return out;
}

/// Makes the event of one of the bifurcations that a solution represents.
/// @param distance from the solution to the bifurcation in the load factor
/// @param shares combination of the null motions whose stiffness vanishes at the bifurcation
CriticalEvent bifurcation_event(const CriticalSolution& found, const Tangents& tangents, double distance,
                                const VectorXd& shares) {
  CriticalEvent event;
  event.type = CriticalType::bifurcation;
  event.point.y = found.y;
  if (distance != 0.0) event.point.y += distance / tangents.along.lambda * tangents.along.y;
  event.point.lambda = found.lambda + distance;
  event.point.tangent = tangents.along.y;
  event.point.tangent_lambda = tangents.along.lambda;
  event.point.perturbed = true;
  event.null = found.null;
  if (shares.size() > 1) event.null.col(0) = found.null * shares;
  event.imperfection = found.imperfection();
  event.across = tangents.across.y;
  event.across_lambda = tangents.across.lambda;
  event.bracket_loads[0] = event.bracket_loads[1] = event.point.lambda;
  return event;
}

/// Solution of Moore's system with tangents and spectrum.
struct Solved {
  CriticalSolution at;
  Tangents tangents;
  CriticalSolution::Spectrum spectrum;
};

std::optional<Solved> solve_on_path(PointSolver& solver, const CriticalGuess& guess, const PathDirection& way,
                                    const CriticalOptions& options) {
  int factorisations = 0;
  auto found = solve_bifurcation(solver.problem(), solver.norm().metric(), guess, options, factorisations);
  solver.statistics().factorizations += factorisations;
  if (!found) return std::nullopt;
  auto tangents = tangents_along(solver.norm().metric(), *found, way);
  auto spectrum = found->spectrum();
  if (!tangents || !spectrum) return std::nullopt;
  return Solved{*std::move(found), *std::move(tangents), *std::move(spectrum)};
}

/// Solves for the target bifurcation itself: predicted from a neighbouring bifurcation, its position has an
/// error of second order in the distance.
CriticalEvent settled(PointSolver& solver, const CriticalEvent& event, Index target, const PathDirection& way,
                      const CriticalOptions& options) {
  const CriticalGuess guess{event.point.y, event.point.lambda, event.null, target};
  const auto found = solve_on_path(solver, guess, way, options);
  if (!found) return event;
  return bifurcation_event(found->at, found->tangents, 0.0, found->spectrum.shares.col(target));
}

/// Whether inertia counts just before the first and after the last bifurcation agree with the events. With
/// one-sided supports the derivatives of the tangent may belong to a contact state that ends there.
bool inertia_confirms(PointSolver& solver, const std::vector<CriticalEvent>& events, double apart) {
  EquilibriumProblem& problem = solver.problem();
  if (!problem.traits().one_sided || events.empty()) return true;
  const auto negative = [&](const CriticalEvent& event, double way) {
    VectorXd residual;
    ++solver.statistics().factorizations;
    return problem
        .linearise(event.point.y + way * event.point.tangent,
                   event.point.lambda + way * event.point.tangent_lambda, residual)
        .negative;
  };
  return negative(events.front(), -apart) == events.front().negative_before &&
         negative(events.back(), apart) == events.back().negative_after;
}

/// Bifurcations next to a guess in the order in which a path in direction `way` meets them: the target and
/// those close to it. Bifurcations within the tolerance count as one of higher multiplicity.
/// @param before negative eigenvalues before the first; -1: any
std::vector<CriticalEvent> bifurcations_near(PointSolver& solver, const CriticalGuess& guess,
                                             const PathDirection& way, int before,
                                             const CriticalOptions& options) {
  const auto solved = solve_on_path(solver, guess, way, options);
  if (!solved) return {};
  const auto& [found, tangents, spectrum] = *solved;
  const auto count = static_cast<int>(found.null.cols());
  const int change = tangents.along.stiffness_rate < 0.0 ? 1 : -1;
  const int first = found.others + (change < 0 ? count : 0);
  if (before >= 0 && before != first) return {};
  const double size = std::max(std::abs(found.lambda), options.least_load);
  std::vector<CriticalEvent> events;
  for (int n = 0; n < count; ++n) {
    const Index i = tangents.along.lambda < 0.0 ? count - 1 - n : n;
    const double distance = count > 1 && i != guess.target ? spectrum.distances[i] : 0.0;
    if (std::abs(distance) > NewtonEventLimits::close * size) break;
    CriticalEvent event = bifurcation_event(found, tangents, distance, spectrum.shares.col(i));
    if (std::abs(distance) > NewtonEventLimits::exact * size) event = settled(solver, event, i, way, options);
    event.negative_before = first + change * n;
    event.negative_after = event.negative_before + change;
    event.point.negative = event.negative_before;
    const double apart = events.empty() ? size : std::abs(event.point.lambda - events.back().point.lambda);
    if (apart > 100.0 * options.tolerance * size) {
      events.push_back(std::move(event));
    } else {
      events.back().negative_after = event.negative_after;
      ++events.back().multiplicity;
    }
  }
  if (!inertia_confirms(solver, events, NewtonEventLimits::beside * options.reach)) return {};
  return events;
}

}  // namespace

std::vector<CriticalEvent> bifurcations_beyond(PointSolver& solver, const PathPoint& from,
                                               const std::vector<Index>& modes, double distance, double reach,
                                               double tolerance) {
  const PathMetric& metric = solver.norm().metric();
  CriticalGuess guess{from.y + distance * from.tangent, from.lambda + distance * from.tangent_lambda,
                      from.modes->motions(Eigen::all, modes),
                      from.tangent_lambda < 0.0 ? static_cast<Index>(modes.size()) - 1 : 0};
  for (Index i = 0; i < guess.null.cols(); ++i)
    guess.y -= distance * metric.inner(from.tangent, 0.0, guess.null.col(i), 0.0) * guess.null.col(i);
  solver.problem().set_context(from.context);
  const PathDirection way{from.tangent, from.tangent_lambda};
  auto events = bifurcations_near(solver, guess, way, from.negative, options_for(solver, tolerance, reach));
  for (const CriticalEvent& event : events)
    if (!(metric.inner(event.point.y - from.y, event.point.lambda - from.lambda, way.y, way.lambda) > 0.0))
      return {};
  double arc = from.arc_length;
  const PathPoint* last = &from;
  for (CriticalEvent& event : events) {
    arc += solver.norm().arc(*last, event.point);
    event.point.arc_length = arc;
    event.point.log_abs_det = from.log_abs_det;
    event.point.context = from.context;
    last = &event.point;
  }
  return events;
}

namespace {

/// Index of the nearest motion with stiffness of the given sign that changes sign within the step; -1: none.
Index crossing_mode(const SoftModes& modes, double sign, double sense) {
  Index best = -1;
  for (Index i = 0; i < modes.count(); ++i) {
    if (!(sign * modes.stiffness[i] > 0.0) || !std::isfinite(modes.distance_to_zero(i, sense))) continue;
    if (best < 0 || modes.distance_to_zero(i, sense) < modes.distance_to_zero(best, sense)) best = i;
  }
  return best;
}

/// Fraction of the step from a to b at which the stiffness is zero: from the cubic through values and rates
/// if both ends have the same motion, else linearly from the nearer end.
double predicted_share(const PathMetric& metric, const SoftModes& a, Index i, const SoftModes& b, Index j,
                       double length) {
  const double from_a = a.distance_to_zero(i, 1.0) / length;
  const double from_b = b.distance_to_zero(j, -1.0) / length;
  if (std::abs(metric.inner(a.motions.col(i), 0.0, b.motions.col(j), 0.0)) < NewtonEventLimits::same_motion)
    return from_a < from_b ? from_a : 1.0 - from_b;
  return Cubic{a.stiffness[i], length * a.rate[i], b.stiffness[j], length * b.rate[j]}.zero();
}

CriticalEvent limit_event(const PointSolver& solver, const CriticalSolution& found, const CriticalEvent& kind,
                          const VectorXd& direction) {
  CriticalEvent event = kind;
  event.point.y = found.y;
  event.point.lambda = found.lambda;
  const VectorXd null = found.null.col(0);
  const double along = solver.norm().metric().inner(null, 0.0, direction, 0.0);
  event.point.tangent = along < 0.0 ? VectorXd(-null) : null;
  event.point.tangent_lambda = 0.0;
  event.point.negative = kind.negative_before;
  event.null = found.null;
  event.bracket_loads[0] = event.bracket_loads[1] = found.lambda;
  return event;
}

/// Solves for the simple critical point of a kind next to a guess, by Newton's method.
/// @param kind type, and negative eigenvalues on both sides
/// @param way direction of the path at the guess
std::optional<CriticalEvent> solve_event(PointSolver& solver, const CriticalGuess& guess,
                                         const CriticalEvent& kind, const PathDirection& way,
                                         const CriticalOptions& options) {
  if (!is_limit(kind.type)) {
    // among neighbouring bifurcations, the one with the given inertia on both sides
    for (CriticalEvent& event : bifurcations_near(solver, guess, way, -1, options)) {
      if (event.negative_before != kind.negative_before || event.negative_after != kind.negative_after)
        continue;
      event.type = kind.type;
      return std::move(event);
    }
    return std::nullopt;
  }
  if (guess.null.cols() != 1) return std::nullopt;
  int factorisations = 0;
  const auto found =
      solve_limit_point(solver.problem(), solver.norm().metric(), guess, options, factorisations);
  solver.statistics().factorizations += factorisations;
  if (!found || found->others != std::min(kind.negative_before, kind.negative_after)) return std::nullopt;
  return limit_event(solver, *found, kind, way.y);
}

}  // namespace

std::optional<CriticalEvent> critical_point_near(PointSolver& solver, const CriticalEvent& known,
                                                 const PathPoint& at, Eigen::MatrixXd null, double reach,
                                                 double tolerance) {
  if (known.cause == CriticalCause::contact) return std::nullopt;
  solver.problem().set_context(at.context);
  CriticalGuess guess{at.y, at.lambda, std::move(null)};
  guess.target = at.tangent_lambda < 0.0 ? guess.null.cols() - 1 : 0;
  auto event = solve_event(solver, guess, known, {at.tangent, at.tangent_lambda},
                           options_for(solver, tolerance, reach));
  if (!event) return std::nullopt;
  event->point.arc_length = at.arc_length;
  event->point.log_abs_det = at.log_abs_det;
  event->point.context = at.context;
  return event;
}

std::optional<CriticalEvent> crossing_between(PointSolver& solver, const Segment& segment, bool limit,
                                              const LocateOptions& options) {
  const PathPoint& a = segment.from();
  const PathPoint& b = segment.to();
  const bool lost = b.negative > a.negative;
  if (!a.modes || !b.modes) return std::nullopt;
  const Index i = crossing_mode(*a.modes, lost ? 1.0 : -1.0, 1.0);
  const Index j = crossing_mode(*b.modes, lost ? -1.0 : 1.0, -1.0);
  if (i < 0 || j < 0) return std::nullopt;
  const PathMetric& metric = solver.norm().metric();
  const double length = segment.length();
  const double share = std::clamp(predicted_share(metric, *a.modes, i, *b.modes, j, length), 0.0, 1.0);
  PathPoint at;
  segment.interpolate(share, at);
  const CriticalGuess guess{at.y, at.lambda, share < 0.5 ? a.modes->motions.col(i) : b.modes->motions.col(j)};
  solver.problem().set_context(a.context);
  CriticalEvent kind;
  kind.type = limit ? limit_type(a) : CriticalType::bifurcation;
  kind.negative_before = a.negative;
  kind.negative_after = b.negative;
  auto event = solve_event(solver, guess, kind, {segment.direction(), segment.direction_lambda()},
                           options_for(solver, options.tolerance, length));
  if (!event || event->imperfection > options.perfect) return std::nullopt;
  const double along = segment.length_to(event->point);
  if (!(along >= 0.0 && along <= length)) return std::nullopt;
  event->point.arc_length = a.arc_length + along / length * (b.arc_length - a.arc_length);
  event->point.log_abs_det = a.log_abs_det;
  event->point.context = a.context;
  return event;
}

}  // namespace snapthrough
