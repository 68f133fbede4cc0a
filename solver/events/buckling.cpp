#include "solver/events/buckling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "solver/events/buckling_pencil.h"
#include "solver/newton/contact_state.h"
#include "solver/newton/corrector.h"
#include "solver/numeric/bracket.h"
#include "solver/numeric/dense.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Limits of the eigenvalue search; loads are relative. Source: digits of the counts, docs/decisions/0001.
struct BucklingLimits {
  static constexpr double held_share = 1e-3;  ///< digits of LinearBuckling::held_share
  static constexpr double tolerance = 1e-14;  ///< relative error of loads that the iteration leaves
  static constexpr double same = 1e-9;        ///< difference of a load from the Rayleigh quotient of its mode
  static constexpr double converged = 1e-13;  ///< change of a load at which inverse iteration ends: rounding
  static constexpr int most_iterations = 60;  ///< inverse iterations at most
  /// Doublings of the first scale; beyond 1e13 times it the elastic stiffness is lost to rounding.
  static constexpr int doublings = 43;
};

/// Load factors by doublings of an estimate of the first buckling load.
struct LoadRange {
  double lowest = 0.0;   ///< no buckling load lies below, and one within twice this; 0: none was found
  double largest = 0.0;  ///< last doubling
};

/// Finds the doubling below the first buckling load. @param at_start inertia at zero
LoadRange range_of_first(BucklingPencil& pencil, int at_start) {
  double first = pencil.scale();
  if (!std::isfinite(first) || first <= 0.0) first = 1.0;
  first *= kOffMultiples;
  LoadRange range{0.0, std::ldexp(first, BucklingLimits::doublings)};
  double at = first;
  if (pencil.factorise(at) != at_start) {
    for (int i = 0; i < BucklingLimits::doublings && range.lowest == 0.0; ++i) {
      at *= 0.5;
      if (pencil.factorise(at) == at_start) range.lowest = at;
    }
    return range;
  }
  for (int i = 0; i < BucklingLimits::doublings && range.lowest == 0.0; ++i) {
    at *= 2.0;
    if (pencil.factorise(at) != at_start) range.lowest = 0.5 * at;
  }
  return range;
}

/// Whether the Rayleigh quotient of each mode is its load.
bool have_their_quotients(BucklingPencil& pencil, const VectorXd& loads, const MatrixXd& modes) {
  for (Index i = 0; i < loads.size(); ++i)
    if (!(std::abs(pencil.quotient(modes.col(i)) - loads[i]) <= BucklingLimits::same * loads[i]))
      return false;
  return true;
}

/// Block inverse iteration with Rayleigh-Ritz on the span of y = J(shift)^-1 G x: (y^T G x) c = (shift -
/// lambda) (y^T G y) c. It evaluates no energies of J_0, which have lost digits where parts of a structure
/// are stiffer than others by 1e14.
/// @return whether the loads have converged
bool iterate(BucklingPencil& pencil, double shift, VectorXd& loads, MatrixXd& modes) {
  pencil.factorise(shift);
  for (int n = 0; n < BucklingLimits::most_iterations; ++n) {
    const MatrixXd forces = pencil.geometric(modes);
    const MatrixXd y = pencil.response(forces);
    const RealEigen found =
        real_eigen(solve_row_pivoting(y.transpose() * forces, y.transpose() * pencil.geometric(y)));
    VectorXd next = (shift - found.values.array().inverse()).matrix();
    std::vector<Index> order(static_cast<std::size_t>(next.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&next](Index a, Index b) { return next[a] < next[b]; });
    const VectorXd before = loads;
    for (Index i = 0; i < loads.size(); ++i) {
      loads[i] = next[order[static_cast<std::size_t>(i)]];
      const VectorXd mode = y * found.vectors.col(order[static_cast<std::size_t>(i)]);
      modes.col(i) = mode / mode.lpNorm<Eigen::Infinity>();
    }
    if (!loads.allFinite() || !modes.allFinite()) return false;
    if (((loads - before).cwiseAbs().array() <= BucklingLimits::converged * loads.cwiseAbs().array()).all())
      return true;
  }
  return false;
}

/// Number of buckling loads below a load factor, by an inertia count.
int count_below(BucklingPencil& pencil, double load, int at_start) {
  return pencil.factorise(load) - at_start;
}

/// The lowest `count` loads of the pencil with its present contact.
void find_loads(BucklingPencil& pencil, int count, LinearBuckling& out) {
  out.loads.clear();
  out.modes.clear();
  out.negative_at_start = pencil.factorise(0.0);
  pencil.set_stable_at_start(out.negative_at_start == 0);
  const LoadRange range = range_of_first(pencil, out.negative_at_start);
  if (range.lowest == 0.0) return;
  pencil.factorise(range.lowest);
  Shift shift{range.lowest, out.negative_at_start};
  EigenSearch search;
  search.count = count;
  search.tolerance = BucklingLimits::tolerance;
  KrylovColumns columns;
  const Eigenpairs found = lowest_eigenpairs(pencil, shift, search, columns);
  VectorXd loads(static_cast<Index>(found.values.size()));
  for (Index i = 0; i < loads.size(); ++i) loads[i] = found.values[static_cast<std::size_t>(i)].real();
  MatrixXd modes = found.vectors;
  bool are_loads = found.complete && found.converged;
  if (loads.size() > 0 && !have_their_quotients(pencil, loads, modes))
    are_loads = iterate(pencil, shift.at, loads, modes) && have_their_quotients(pencil, loads, modes) &&
                count_below(pencil, (1.0 - BucklingLimits::same) * loads[0], out.negative_at_start) == 0;
  for (Index i = 0; i < loads.size(); ++i) {
    if (!(loads[i] > range.lowest && loads[i] < range.largest)) continue;
    out.loads.push_back(loads[i]);
    out.modes.push_back(modes.col(i) / modes.col(i).lpNorm<Eigen::Infinity>());
  }
  const auto all = static_cast<int>(out.loads.size());
  out.complete =
      are_loads && (all == count || count_below(pencil, range.largest, out.negative_at_start) == all);
}

/// Largest compression of each member at the Gauss points and the ends of its elements.
std::vector<double> compressions_of(const Structure& structure, const VectorXd& stress) {
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const auto p = static_cast<std::size_t>(rule.order());
  std::array<std::array<double, kMaxOrder>, 2> at_end{};  // polynomial through the Gauss points, at 0 and 1
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
    rule.values_at(static_cast<double>(end), std::span(at_end[end]).first(p));
  std::vector<double> out;
  for (std::size_t m = 0; m + 1 < structure.mesh.first.size(); ++m) {
    double least = std::numeric_limits<double>::infinity();  // axial force
    for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e) {
      const double* axial = stress.data() + structure.dofs[static_cast<std::size_t>(e)].s;
      for (const auto& weights : at_end)
        least = std::min(least, std::inner_product(axial, axial + p, weights.begin(), 0.0));
      least = std::min(least, *std::min_element(axial, axial + p));
    }
    out.push_back(-least);
  }
  return out;
}

/// Largest share of a load with an equilibrium of small displacements. The loads with one form an interval,
/// because no law falls.
double held_share(StructuralProblem& problem, double load, int& factorizations) {
  return bisect(0.0, 1.0, BucklingLimits::held_share,
                [&](double share) { return !linear_contact(problem, share * load, factorizations); });
}

PieceSolver solver_of(BucklingPencil& pencil) {
  PieceSolver solver;
  solver.lowest = [&pencil]() -> std::optional<Piece> {
    LinearBuckling found;
    find_loads(pencil, 1, found);
    if (found.loads.empty() || found.negative_at_start > 0) return std::nullopt;
    return Piece{found.loads.front(), std::move(found.modes.front())};
  };
  solver.quotient = [&pencil](const VectorXd& motion) { return pencil.quotient(motion); };
  return solver;
}

}  // namespace

LinearBuckling linear_buckling(const Structure& structure, StructuralProblem& problem, int count,
                               double reference, const VectorXd& near, LoadSense sense) {
  LinearBuckling out;
  BucklingPencil pencil(structure, problem, sense);
  if (!pencil.set_prestress(reference)) {
    out.factorizations = pencil.factorizations();
    out.held_share = held_share(problem, reference, out.factorizations);
    return out;
  }
  out.holds = pencil.holds();
  out.contact = out.pressed = pencil.contact();
  out.is_mechanism = !pencil.holds_are_idle(reference);
  if (out.is_mechanism) return out;
  const TouchingMarks& marks = pencil.marks();
  out.touches = structure.one_sided && structure.free_motions.cols() == 0 && has_any(marks);
  if (out.touches) out.piece = set_least_piece(problem, solver_of(pencil), marks, near, pencil.contact());
  find_loads(pencil, count, out);
  for (const double load : out.loads)
    out.compressions.push_back(compressions_of(structure, pencil.stress(load)));
  out.factorizations = pencil.factorizations();
  out.marks = marks;
  out.contact = std::move(pencil.contact());
  return out;
}

std::optional<FrozenContact> linear_contact(StructuralProblem& problem, double lambda, int& factorizations) {
  const PathMetric metric{&problem.metric(), 0.0};
  Workspace work;
  problem.set_holds(held_softly(problem));
  const auto state = find_contact_state(problem, metric, lambda, work, factorizations, nullptr, true);
  if (!state) return std::nullopt;
  return problem.frozen_contact(state->y, true);
}

}  // namespace snapthrough
