#include "solver/path/path_start.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "solver/numeric/rounding.h"
#include "solver/problem/held_motions.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Numbers of the search for a first state.
struct StartSearch {
  /// Largest ratio of the displacement gradients of a first state to those of small displacements under the
  /// same load: beyond it the structure has moved to another state. A rotation that can just close a gap is
  /// twice that of small displacements: from an angle a it moves sin(a + t) - sin(a), which they take for t
  /// cos(a). A chain of such members may need somewhat more.
  static constexpr double far = 3.0;
  static constexpr int corrections = 25;        ///< most Newton corrections of a state that is nearly at rest
  static constexpr int touch_corrections = 60;  ///< most corrections where supports touch without pressure
  static constexpr double largest_fall = 1e-3;  ///< least factor from one small load to the next
  static constexpr double fall_without_state =
      0.01;                                    ///< factor to the next small load where no state was found
  static constexpr double small = 10.0;        ///< displacement, over Gradients::tiny, that is small enough
  static constexpr double proportional = 0.5;  ///< share of the last displacement that did not fall with it
  /// Largest relative difference of two responses that are one.
  static constexpr double same_response = 0.1;
};

/// A load that is small by what it moves and, since a thin column hardly moves before it buckles, by what the
/// load counts for in the path's norm at least.
/// @param response norm of the displacement by unit load
double small_load(double response, double load_scale) {
  return Gradients::tiny * std::min(1.0 / response, load_scale / Gradients::small);
}

/// The search for a path's first point under given holds.
class StartFinder {
 public:
  StartFinder(PointSolver& solver, double direction, double largest_first_load)
      : solver_(solver), direction_(direction), largest_first_load_(largest_first_load) {}

  /// The first point of a path with one-sided supports.
  [[nodiscard]] PathStart run();

 private:
  [[nodiscard]] std::optional<PathPoint> under_small_load();
  [[nodiscard]] std::optional<PathPoint> pinned_softly(const SharedHolds& soft, SoftlyHeld& met,
                                                       PathPoint& loaded);
  [[nodiscard]] bool lower_to_own_stiffness(double& lambda);
  void begin_unmoved(const LoadResponse& response, const LoadResponse& bilateral, PathPoint& start);
  [[nodiscard]] std::optional<PathPoint> at_rest(PathPoint rest);
  [[nodiscard]] std::optional<PathPoint> near_small_displacements(double lambda);
  [[nodiscard]] std::optional<PathPoint> where_gaps_close(PathPoint pressed, double lambda);
  [[nodiscard]] bool is_far(const PathPoint& rest);
  [[nodiscard]] PathPoint unloaded() const;
  [[nodiscard]] std::optional<ContactState> contact(double lambda, const VectorXd* guess,
                                                    bool small_displacements = false) {
    return solver_.contact_state(lambda, holds_, guess, small_displacements);
  }
  [[nodiscard]] double norm(const VectorXd& y) const { return solver_.norm().metric().norm(y, 0.0); }

  PointSolver& solver_;
  double direction_;
  double largest_first_load_;
  SharedHolds holds_;  ///< springs against free motions in the states that are looked for
  PathStart out_;
};

/// Sets the norm's scales from a response and the point's tangent.
void begin(PointSolver& solver, double direction, const LoadResponse& response, PathPoint& point) {
  solver.norm().set_scales(solver.problem(), response.rate);
  solver.set_tangent(point, response, direction);
}

/// Sets the scales and the tangent of a point in equilibrium; false where the tangent stiffness is singular.
bool begin_at(PointSolver& solver, double direction, PathPoint& equilibrium) {
  const auto response = solver.response_at(equilibrium, Regime::Contact::unilateral);
  if (response) begin(solver, direction, *response, equilibrium);
  return response.has_value();
}

PathPoint StartFinder::unloaded() const {
  PathPoint point;
  point.y = VectorXd::Zero(solver_.problem().size());
  point.context.holds = holds_;
  return point;
}

/// Whether a state at rest lies farther from the unloaded one than gaps and elastic strains explain.
bool StartFinder::is_far(const PathPoint& rest) {
  const auto near = contact(rest.lambda, nullptr, true);
  if (!near) return false;
  const FarState state{norm(rest.y), norm(near->y)};
  if (state.gradient <= StartSearch::far * state.small_displacement_gradient) return false;
  out_.far_state = state;
  return true;
}

/// The first point at a state that the structure moved to under a very small load, corrected to rounding.
std::optional<PathPoint> StartFinder::at_rest(PathPoint rest) {
  rest.context.holds = holds_;
  const auto outcome = solver_.correct_by_least_energy(norm(rest.y), StartSearch::corrections, rest);
  if (outcome.status != CorrectorStatus::converged || is_far(rest)) return std::nullopt;
  PathPoint start;
  start.y = rest.y;
  start.lambda = rest.lambda;
  start.context.holds = holds_;
  return begin_at(solver_, direction_, start) ? std::optional(std::move(start)) : std::nullopt;
}

/// The first point at the state of rest that is found from small displacements under a load.
std::optional<PathPoint> StartFinder::near_small_displacements(double lambda) {
  const auto near = contact(lambda, nullptr, true);
  if (!near) return std::nullopt;
  PathPoint rest;
  rest.y = near->y;
  rest.lambda = lambda;
  return at_rest(std::move(rest));
}

/// The first point at a state of rest where gaps have closed, if there is one, or at the one under a load.
/// Soft springs of pinned motions may stand in for a structure that does not stand by itself.
std::optional<PathPoint> StartFinder::where_gaps_close(PathPoint pressed, double lambda) {
  if (pressed.y.size() > 0)
    if (auto found = at_rest(std::move(pressed))) return found;
  return near_small_displacements(lambda);
}

/// Lowers a load, under which gaps have closed, to one that is very small for the structure without the
/// supports that it does not press.
/// @return false where the structure does not stand by itself, or the load is as small already
bool StartFinder::lower_to_own_stiffness(double& lambda) {
  const auto own = solver_.response_at(unloaded(), Regime::Contact::unilateral);
  if (!own) return false;
  const double most = small_load(norm(own->rate), solver_.problem().critical_load_scale(own->rate));
  if (std::abs(lambda) <= most) return false;
  lambda = direction_ * most;
  return true;
}

/// Begins where a small load moves the ground alone, until its gap to the structure closes: the displacements
/// of the structure are rounding. The norm's scales are those of the structure that moves with its supports.
void StartFinder::begin_unmoved(const LoadResponse& response, const LoadResponse& bilateral,
                                PathPoint& start) {
  LoadResponse moved = response;
  const double rounding = Rounding::displacement * moved.rate.lpNorm<Eigen::Infinity>();
  moved.rate = (moved.rate.array().abs() > rounding).select(moved.rate, 0.0);
  solver_.norm().set_scales(solver_.problem(), bilateral.rate);
  solver_.set_tangent(start, moved, direction_);
}

/// The first point by the contact under a very small load. The load falls until the displacement is small, or
/// no longer falls with it because gaps have closed: then a structure that stands by itself is looked at
/// under a load that closes none, and the path of another one begins where it comes to rest.
std::optional<PathPoint> StartFinder::under_small_load() {
  PathPoint start = unloaded();
  auto bilateral = solver_.response_at(start, Regime::Contact::bilateral);
  if (!bilateral) return std::nullopt;
  const double flexibility = norm(bilateral->rate);
  if (flexibility == 0.0) {
    begin(solver_, direction_, *bilateral, start);
    return start;
  }
  const double first =
      direction_ * std::min(small_load(flexibility, solver_.problem().critical_load_scale(bilateral->rate)),
                            largest_first_load_);
  double lambda = first;
  double last = std::numeric_limits<double>::infinity();
  VectorXd guess;
  PathPoint rest;     // at the load before, which holds the structure better than this one
  PathPoint pressed;  // that where gaps have closed
  double least = kRoundingResidual * std::abs(lambda);
  while (std::abs(lambda) > least) {
    const auto state = contact(lambda, guess.size() > 0 ? &guess : nullptr);
    const double size = state ? norm(state->y) : 0.0;
    if (state && size <= StartSearch::small * Gradients::tiny) {
      VectorXd motion = solver_.free_motion();
      if (motion.size() > 0) {
        out_.free_motion = std::move(motion);
        return std::nullopt;
      }
      const LoadResponse response{state->y / lambda, state->tangent};
      if (size <= Rounding::displacement * std::abs(lambda) * flexibility) {
        begin_unmoved(response, *bilateral, start);
        return start;
      }
      out_.contact_flexibility_ratio = size / std::abs(lambda * flexibility);
      begin(solver_, direction_, response, start);
      return start;
    }
    if (state && size > StartSearch::proportional * last) {
      if (!lower_to_own_stiffness(lambda)) {
        if (auto found = at_rest(std::move(rest))) return found;
        break;
      }
      pressed = rest;
      last = std::numeric_limits<double>::infinity();
      least = kRoundingResidual * std::abs(lambda);
      guess.resize(0);
      continue;
    }
    const double fall =
        state ? std::max(Gradients::tiny / size, StartSearch::largest_fall) : StartSearch::fall_without_state;
    if (state) {
      last = size;
      rest.y = state->y;
      rest.lambda = lambda;
      guess = fall * state->y;
    }
    lambda *= fall;
  }
  return where_gaps_close(std::move(pressed), first);
}

/// The first point with all free motions pinned softly: then there is one whatever one-sided supports do, and
/// it shows which of the motions they resist.
/// @param met which motions something resists; as it is where there is no such point
/// @param loaded state under a small load; set where there is one
std::optional<PathPoint> StartFinder::pinned_softly(const SharedHolds& soft, SoftlyHeld& met,
                                                    PathPoint& loaded) {
  holds_ = soft;
  auto start = under_small_load();
  if (start) {
    const double rate = std::abs(start->tangent_lambda);
    const double moved = norm(start->tangent);
    const double size = small_load(moved / rate, solver_.norm().load_scale()) / rate;
    loaded.y = start->y + size * start->tangent;
    loaded.lambda = start->lambda + size * start->tangent_lambda;
    solver_.problem().set_holds(soft);
    met = softly_held(solver_.problem(), soft, loaded.y, loaded.lambda);
    ++solver_.statistics().factorizations;
    start->context.holds = nullptr;
  }
  holds_ = nullptr;
  out_.free_motion.resize(0);
  out_.far_state.reset();
  return start;
}

PathStart StartFinder::run() {
  SoftlyHeld met;
  PathPoint loaded;
  if (const SharedHolds soft = held_softly(solver_.problem())) {
    out_.point = pinned_softly(soft, met, loaded);
    if (met.resisted) {
      solver_.problem().set_holds(nullptr);
      return std::move(out_);
    }
  }
  holds_ = met.neutral;
  out_.point = under_small_load();
  // a motion that only the loads stiffen leaves the structure with bilateral supports singular
  if (!out_.point && loaded.y.size() > 0) out_.point = at_rest(std::move(loaded));
  return std::move(out_);
}

/// Where supports touch without pressure the tangent at the start takes them as absent. The direction becomes
/// that of the equilibrium under a little load, if it is another.
void turn_where_supports_touch(PointSolver& solver, double direction, const VectorXd& response,
                               PathPoint& start) {
  const PathMetric& metric = solver.norm().metric();
  const double norm = metric.norm(response, 0.0);
  PathPoint next;
  next.lambda = direction * small_load(norm, solver.norm().load_scale());
  next.y = start.y + next.lambda * response;
  next.context = start.context;
  const auto outcome =
      solver.correct_by_least_energy(std::abs(next.lambda) * norm, StartSearch::touch_corrections, next);
  if (outcome.status != CorrectorStatus::converged) return;
  const VectorXd rate = (next.y - start.y) / next.lambda;
  if (metric.norm(rate - response, 0.0) > StartSearch::same_response * metric.norm(rate, 1.0))
    begin(solver, direction, {rate, outcome.tangent}, start);
}

}  // namespace

PathStart find_start(PointSolver& solver, double direction, double largest_first_load) {
  if (!solver.problem().traits().one_sided) {
    const SharedHolds soft = held_softly(solver.problem());
    const SharedHolds all =
        soft ? std::make_shared<const Holds>(Holds{soft->motions, soft->at, 1.0}) : nullptr;
    return start_at_equilibrium(solver, VectorXd::Zero(solver.problem().size()), direction, {all, nullptr});
  }
  solver.norm().ignore_load();
  return StartFinder(solver, direction, largest_first_load).run();
}

PathStart start_at_equilibrium(PointSolver& solver, const VectorXd& y, double direction,
                               const PointContext& context) {
  solver.norm().ignore_load();
  PathPoint start;
  start.y = y;
  start.context = context;
  PathStart out;
  const auto response = solver.response_at(start, Regime::Contact::unilateral);
  if (!response) return out;
  begin(solver, direction, *response, start);
  if (solver.problem().traits().one_sided)
    turn_where_supports_touch(solver, direction, response->rate, start);
  out.point = std::move(start);
  return out;
}

PathStart start_near(PointSolver& solver, const VectorXd& y, double lambda, double direction) {
  solver.norm().ignore_load();
  PathPoint start;
  start.y = y;
  start.lambda = lambda;
  PathStart out;
  const auto outcome =
      solver.correct_by_least_energy(solver.norm().metric().norm(y, 0.0), StartSearch::corrections, start);
  if (outcome.status == CorrectorStatus::converged && begin_at(solver, direction, start))
    out.point = std::move(start);
  return out;
}

}  // namespace snapthrough
