#include "solver/path/point_solver.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "solver/numeric/pseudo_random.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Numbers of the search for the softest motions.
struct ModeSearch {
  static constexpr int ahead = 2;  ///< motions with stiffness that are wanted, the softest
  static constexpr int most = 8;   ///< motions in all
  static constexpr int iterations =
      3;  ///< steps of the block iteration when no neighbour's motions are known
};

/// The softest motions with the problem's factors; null where there are none.
/// @param negative eigenvalues of the factorised tangent stiffness
std::shared_ptr<SoftModes> modes_of_factors(EquilibriumProblem& problem, int negative,
                                            const SharedModes& start) {
  const int count = std::min(ModeSearch::ahead + negative, ModeSearch::most);
  const Eigen::MatrixXd none;
  auto modes = std::make_shared<SoftModes>(start ? soft_modes(problem, start->motions, count, 1)
                                                 : soft_modes(problem, none, count, ModeSearch::iterations));
  return modes->count() == 0 ? nullptr : modes;
}

}  // namespace

int count_next_to(int before, const TangentReport& report) {
  if (!report.parity_only || report.negative == 0) return report.negative;
  if (report.negative % 2 == before % 2) return before;
  return report.negative > before ? before + 1 : before - 1;
}

PointSolver::PointSolver(EquilibriumProblem& problem, CorrectorOptions options)
    : problem_(problem), options_(options), norm_(problem.metric()) {}

std::optional<LoadResponse> PointSolver::response_at(const PathPoint& point, Regime::Contact contact) {
  problem_.set_context(point.context);
  Regime regime;
  regime.contact = contact;
  LoadResponse out;
  out.tangent = problem_.linearise(point.y, point.lambda, work_.residual, regime);
  ++statistics_.factorizations;
  problem_.load(point.y, point.lambda, out.rate);
  problem_.solve(out.rate);
  if (!out.rate.allFinite() || norm_.metric().norm(out.rate, 0.0) >= kSingularResponse) return std::nullopt;
  return out;
}

void PointSolver::set_tangent(PathPoint& point, const LoadResponse& response, double sign) {
  const double norm = sign * norm_.metric().norm(response.rate, 1.0);
  point.tangent = response.rate / norm;
  point.tangent_lambda = 1.0 / norm;
  point.negative = response.tangent.negative;
  point.log_abs_det = response.tangent.log_abs_det;
  symmetric_ = !response.tangent.parity_only;
}

void PointSolver::set_tangent(PathPoint& point, const CorrectorOutcome& outcome, int before,
                              const VectorXd& direction, double direction_lambda) {
  const PathMetric& metric = norm_.metric();
  const double norm = metric.norm(work_.load_response(), 1.0);
  const double sign =
      metric.inner(work_.load_response(), 1.0, direction, direction_lambda) < 0.0 ? -1.0 : 1.0;
  point.tangent = (sign / norm) * work_.load_response();
  point.tangent_lambda = sign / norm;
  point.negative = count_next_to(before, outcome.tangent);
  point.log_abs_det = outcome.tangent.log_abs_det;
  symmetric_ = !outcome.tangent.parity_only;
}

CorrectorOutcome PointSolver::correct_with(const SideCondition& side, double scale,
                                           const CorrectorOptions& options, PathPoint& point) {
  problem_.set_context(point.context);
  const auto outcome = correct(problem_, norm_.metric(), side, scale, options, point.y, point.lambda, work_);
  statistics_.factorizations += outcome.factorisations;
  statistics_.iterations += outcome.factorisations;
  return outcome;
}

CorrectorOutcome PointSolver::correct_in_plane(const VectorXd& normal, double normal_lambda, double scale,
                                               const CorrectorOptions& options, PathPoint& point) {
  side_.normal = norm_.metric().weights->cwiseProduct(normal);
  side_.normal_lambda = norm_.metric().load_weight * normal_lambda;
  return correct_with(side_, scale, options, point);
}

bool PointSolver::correct_at_load(double scale, PathPoint& point) {
  return correct_with({}, scale, options_, point).status == CorrectorStatus::converged;
}

CorrectorOutcome PointSolver::correct_by_least_energy(double scale, int iterations, PathPoint& point) {
  return correct_with({}, scale, downhill(options_, iterations), point);
}

namespace {

/// Limits of the search for a state that tension stiffens. Chosen: chains of up to 100 rods take 24 to 48
/// factorisations with them.
struct TightSearch {
  static constexpr int steps = 200;
  static constexpr int corrections = 60;     ///< Newton corrections of each step
  static constexpr double first_drag = 1.0;  ///< over the stiffness of a rod
  static constexpr double fall = 0.1;        ///< factor on the drag after a step
  static constexpr double most_drag = 1e6;   ///< beyond it the search ends
  static constexpr double near = 0.1;        ///< step over the displacements from which drag is left out
};

}  // namespace

bool PointSolver::find_tight_state(double lambda, VectorXd& y) {
  PathPoint point;
  point.y = y;
  point.lambda = lambda;
  double drag = TightSearch::first_drag;
  for (int step = 0; step < TightSearch::steps && drag < TightSearch::most_drag; ++step) {
    const VectorXd from = point.y;
    CorrectorOptions options = downhill(options_, TightSearch::corrections);
    options.regime.drag = drag;
    options.regime.dragged_from = &from;
    const double size = std::max(norm_.metric().norm(from, 0.0), Gradients::tiny);
    if (correct_with({}, size, options, point).status != CorrectorStatus::converged) {
      point.y = from;
      point.lambda = lambda;
      drag /= TightSearch::fall;
      continue;
    }
    drag *= TightSearch::fall;
    const double moved = norm_.metric().norm(point.y - from, 0.0);
    if (moved > TightSearch::near * norm_.metric().norm(point.y, 0.0)) continue;
    PathPoint free = point;
    const auto outcome = correct_by_least_energy(moved, TightSearch::corrections, free);
    if (outcome.status != CorrectorStatus::converged || outcome.tangent.negative > 0) continue;
    y = std::move(free.y);
    return true;
  }
  return false;
}

std::optional<ContactState> PointSolver::contact_state(double lambda, const SharedHolds& holds,
                                                       const VectorXd* guess, bool small_displacements) {
  problem_.set_holds(holds);
  return find_contact_state(problem_, norm_.metric(), lambda, work_, statistics_.factorizations, guess,
                            small_displacements);
}

VectorXd PointSolver::unresisted_motion() {
  const PathMetric& metric = norm_.metric();
  VectorXd motion = metric.weights->cwiseProduct(pseudo_random(problem_.size(), 1U));
  problem_.solve(motion);
  return metric.norm(motion, 0.0) < kSingularResponse ? VectorXd() : motion;
}

VectorXd PointSolver::free_motion() {
  const PathMetric& metric = norm_.metric();
  VectorXd motion = unresisted_motion();
  if (motion.size() == 0) return {};
  const double size = metric.norm(motion, 0.0);
  VectorXd held = metric.weights->cwiseProduct(pseudo_random(problem_.size(), 1U));
  Regime bilateral;
  bilateral.contact = Regime::Contact::bilateral;
  problem_.linearise(VectorXd::Zero(problem_.size()), 0.0, work_.residual, bilateral);
  ++statistics_.factorizations;
  problem_.solve(held);
  if (size < kSingularResponse * metric.norm(held, 0.0)) return {};
  return motion;
}

int PointSolver::negative_at(const PathPoint& point) {
  problem_.set_context(point.context);
  ++statistics_.factorizations;
  return count_next_to(point.negative, problem_.linearise(point.y, point.lambda, work_.residual));
}

void PointSolver::find_modes(PathPoint& point, const SharedModes& start) {
  point.modes = nullptr;
  if (!symmetric_) return;
  auto modes = modes_of_factors(problem_, point.negative, start);
  if (!modes) return;
  const Eigen::MatrixXd change =
      problem_.tangent_change(point.y, point.lambda, {point.tangent, point.tangent_lambda}, modes->motions);
  modes->rate.resize(modes->count());
  for (Eigen::Index i = 0; i < modes->count(); ++i)
    modes->rate[i] = problem_.work(change.col(i), modes->motions.col(i));
  point.modes = std::move(modes);
}

void PointSolver::find_first_modes(PathPoint& start) {
  problem_.set_context(start.context);
  problem_.linearise(start.y + Gradients::tiny * start.tangent,
                     start.lambda + Gradients::tiny * start.tangent_lambda, work_.residual);
  ++statistics_.factorizations;
  if (!problem_.traits().one_sided)
    find_modes(start, nullptr);
  else if (symmetric_)
    start.modes = modes_of_factors(problem_, start.negative, nullptr);
}

void recorrect_to_rounding(PointSolver& solver, const PathPoint& from, PathPoint& point) {
  CorrectorOptions options = solver.options();
  if (options.tangent_tolerance == 0.0 && !solver.problem().traits().one_sided) return;
  options.tangent_tolerance = 0.0;
  PathPoint corrected = point;
  const double scale = std::min(solver.norm().distance(from, point), Gradients::large);
  const auto outcome =
      solver.correct_in_plane(point.tangent, point.tangent_lambda, scale, options, corrected);
  if (outcome.status != CorrectorStatus::converged) return;
  solver.set_tangent(corrected, outcome, from.negative, point.tangent, point.tangent_lambda);
  point = std::move(corrected);
}

}  // namespace snapthrough
