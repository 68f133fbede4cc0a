#include "solver/events/massless.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "solver/events/root_finder.h"
#include "solver/numeric/pseudo_random.h"
#include "solver/path/segment.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Limits of the search; ratios.
struct MasslessLimits {
  /// sigma over the largest eigenvalue: the load is off by its inverse, and products with the masses keep
  /// seven digits beside the stiffness.
  static constexpr double sigma = 1e9;
  static constexpr int places = 4;       ///< pieces of a step at whose ends the determinant is evaluated
  static constexpr int iterations = 4;   ///< iterations of the inverse iteration for the motion
  static constexpr double fast = 1e8;    ///< squared rate of a fast growth, over that of a member alone
  static constexpr double faster = 1e2;  ///< squared rate of a faster one, over that of the fast one
  /// Displacement at the faster rate over that at the fast one, above which a place has no mass.
  static constexpr double still = 0.5;
};

/// Displacements of places by unit forces there, along x and y, in vibrations that are forced at one rate.
/// @param rate of growth, squared
template <class Load>
VectorXd moved_by_unit_forces(const Structure& structure, const MassMatrix& masses,
                              const std::vector<Load>& loads, double rate) {
  MatrixXd forces = MatrixXd::Zero(structure.size, 2 * static_cast<Index>(loads.size()));
  for (std::size_t i = 0; i < loads.size(); ++i)
    for (const auto& term : loads[i].terms) {
      forces(term.x, 2 * static_cast<Index>(i)) += term.weight;
      forces(term.y, 2 * static_cast<Index>(i) + 1) += term.weight;
    }
  StructuralProblem problem(structure);
  Regime regime;
  regime.masses = &masses.elements;
  regime.shift = -rate;
  VectorXd residual;
  problem.linearise(VectorXd::Zero(structure.size), 0.0, residual, regime);
  MatrixXd moved = forces;
  problem.to_rows(moved);
  problem.solve(moved);
  return forces.cwiseProduct(moved).colwise().sum().cwiseAbs();
}

/// Whether the place of some load has no mass: then forces that grow fast move it as much as those that grow
/// faster; a mass moves by the inverse square of the rate.
template <class Load>
bool any_is_massless(const Structure& structure, const MassMatrix& masses, const std::vector<Load>& loads) {
  if (loads.empty()) return false;
  const double fast = MasslessLimits::fast * masses.scale;
  const VectorXd slow = moved_by_unit_forces(structure, masses, loads, fast);
  const VectorXd faster = moved_by_unit_forces(structure, masses, loads, MasslessLimits::faster * fast);
  return (faster.array() > MasslessLimits::still * slow.array()).any();
}

}  // namespace

bool has_massless_elements(const MassMatrix& masses) {
  return std::ranges::any_of(masses.blocks,
                             [](const MassBlocks& element) { return element.moving.size() == 0; });
}

bool follows_without_mass(const Structure& structure, const MassMatrix& masses) {
  return any_is_massless(structure, masses, structure.follower_ends) ||
         any_is_massless(structure, masses, structure.follower_forces);
}

MasslessSearch::MasslessSearch(const Structure& structure, const MassMatrix& masses,
                               StructuralProblem::Stage stage)
    : structure_(structure), masses_(masses), problem_(structure) {
  problem_.set_stage(stage);
}

/// det(J + sigma M) over the unit of determinants.
double MasslessSearch::determinant(const PathPoint& point) {
  Regime regime;
  regime.masses = &masses_.elements;
  regime.shift = -sigma_;
  VectorXd residual;
  const TangentReport report = problem_.linearise(point.y, point.lambda, residual, regime);
  return (report.negative % 2 == 0 ? 1.0 : -1.0) * std::exp(report.log_abs_det - log_scale_);
}

std::optional<CriticalEvent> MasslessSearch::on_step(PointSolver& solver, const PathPoint& from,
                                                     const PathPoint& to, double largest, double tolerance) {
  if (sigma_ == 0.0) {
    sigma_ = MasslessLimits::sigma * largest;
    log_scale_ = std::log(std::abs(determinant(from)));
  }
  const Segment segment(solver, from, to);
  PathPoint last = from;
  double value = determinant(last);
  for (int i = 1; i <= MasslessLimits::places; ++i) {
    const auto point = i == MasslessLimits::places
                           ? std::optional(to)
                           : segment.point_at(static_cast<double>(i) / MasslessLimits::places);
    if (!point) continue;
    const double next = determinant(*point);
    if ((next > 0.0) != (value > 0.0)) return locate(solver, last, value, *point, next, tolerance);
    last = *point;
    value = next;
  }
  return std::nullopt;
}

std::optional<CriticalEvent> MasslessSearch::locate(PointSolver& solver, const PathPoint& from,
                                                    double value_from, const PathPoint& to, double value_to,
                                                    double tolerance) {
  const RootFunction function{[&](const PathPoint& at) { return determinant(at); },
                              [tolerance](const PathPoint& a, const PathPoint& b, double) {
                                return std::abs(a.lambda - b.lambda) <=
                                       tolerance * std::max(std::abs(a.lambda), std::abs(b.lambda));
                              }};
  const LocatedRoot root = find_root(Segment(solver, from, to), value_from, value_to, function);
  CriticalEvent event;
  event.type = CriticalType::bifurcation;
  event.cause = CriticalCause::massless;
  event.point = root.root;
  event.bracket_loads[0] = root.before.lambda;
  event.bracket_loads[1] = root.after.lambda;
  // the motion whose frequency becomes infinite, by inverse iteration beside the root, where nothing is
  // singular
  static_cast<void>(determinant(root.before));
  MatrixXd motion = pseudo_random(structure_.size, 1U);
  for (int i = 0; i < MasslessLimits::iterations; ++i) {
    motion = structure_.metric.cwiseProduct(motion.col(0));
    problem_.to_rows(motion);
    problem_.solve(motion);
    motion /= motion.norm();
  }
  event.null = motion;
  return event;
}

}  // namespace snapthrough
