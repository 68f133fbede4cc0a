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
#include "solver/problem/held_motions.h"

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
  /// Distances from a load of the inertia counts that confirm it by themselves: rounding leaves a load so
  /// many digits at least.
  static constexpr std::array counted{1e-6, 1e-5};
  /// Distance of the counts that confirm a load together with the Rayleigh quotient of its mode.
  static constexpr double farther = 1e-4;
  static constexpr double near = 1e-4;         ///< difference of neighbouring loads that form a group
  static constexpr double below_group = 1e-5;  ///< distance of a group's shift from its lowest load
  static constexpr double converged = 1e-13;   ///< change of a load at which inverse iteration ends: rounding
  static constexpr int most_iterations = 60;   ///< inverse iterations at most
  /// Doublings of the first scale; beyond 1e13 times it the elastic stiffness is lost to rounding.
  static constexpr int doublings = 43;
  /// Halvings of the first scale: where the loads that grow press no member, rounding alone gives it.
  static constexpr int halvings = 100;
};

/// Load factors by doublings of an estimate of the first buckling load.
struct LoadRange {
  double lowest = 0.0;   ///< no buckling load lies below, and one within twice this; 0: none was found
  double largest = 0.0;  ///< last doubling
};

/// Finds two load factors, the larger twice the smaller, between which the first buckling load is.
/// @param at_start inertia at zero
LoadRange range_of_first(BucklingPencil& pencil, int at_start) {
  double first = pencil.scale();
  if (!std::isfinite(first) || first <= 0.0) first = 1.0;
  first *= kOffMultiples;
  LoadRange range{0.0, std::ldexp(first, BucklingLimits::doublings)};
  double at = first;
  if (pencil.factorise(at) != at_start) {
    for (int i = 0; i < BucklingLimits::halvings && range.lowest == 0.0; ++i) {
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
/// @param loads, modes the loads next to the shift, to begin with; overwritten by those of the last iteration
/// @return whether the loads have converged
bool iterate(BucklingPencil& pencil, double shift, Eigen::Ref<VectorXd> loads, Eigen::Ref<MatrixXd> modes) {
  pencil.factorise(shift);
  for (int n = 0; n < BucklingLimits::most_iterations; ++n) {
    const MatrixXd forces = pencil.geometric(modes);
    const MatrixXd y = pencil.response(forces);
    const RealEigen found =
        real_eigen(solve_row_pivoting(y.transpose() * forces, y.transpose() * pencil.geometric(y)));
    VectorXd next = (shift - found.values.array().inverse()).matrix();
    // motions of equal loads have become one
    if (!next.allFinite() || !found.vectors.allFinite()) return false;
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

/// Brings approximate loads to rounding, each group of near ones with a shift below it: other loads, of the
/// opposite sense too, may be nearer to a shift that is the same for all.
/// @return whether each load has converged next to where it was
bool polish(BucklingPencil& pencil, VectorXd& loads, MatrixXd& modes) {
  for (Index first = 0; first < loads.size();) {
    Index end = first + 1;
    while (end < loads.size() && loads[end] - loads[end - 1] <= BucklingLimits::near * loads[end]) ++end;
    const VectorXd before = loads.segment(first, end - first);
    const double shift = (1.0 - BucklingLimits::below_group) * before[0];
    if (!iterate(pencil, shift, loads.segment(first, end - first), modes.middleCols(first, end - first)))
      return false;
    if (!(loads.segment(first, end - first) - before).isZero(BucklingLimits::near * before[0])) return false;
    first = end;
  }
  return true;
}

/// Brings loads to rounding; together, by the shift of the search, where they are too far from it for
/// polish().
bool settle(BucklingPencil& pencil, double shift, VectorXd& loads, MatrixXd& modes) {
  VectorXd polished = loads;
  MatrixXd motions = modes;
  if (!polish(pencil, polished, motions)) return iterate(pencil, shift, loads, modes);
  loads = std::move(polished);
  modes = std::move(motions);
  return true;
}

/// Whether inertia counts on both sides of each group of equal loads agree with the list of loads.
/// @param below inertia below the loads
/// @param distance of the counts from the loads; loads within it are equal
bool are_counted(BucklingPencil& pencil, const VectorXd& loads, int below, double distance) {
  const Index count = loads.size();
  for (Index first = 0; first < count;) {
    Index end = first + 1;
    while (end < count && loads[end] - loads[end - 1] <= 2.0 * distance * loads[end]) ++end;
    if (pencil.factorise((1.0 - distance) * loads[first]) != below + static_cast<int>(first)) return false;
    const int beyond = pencil.factorise((1.0 + distance) * loads[end - 1]) - below;
    // the last of several equal loads may be beyond those that are asked for
    if (beyond < static_cast<int>(end) || (end < count && beyond > static_cast<int>(end))) return false;
    first = end;
  }
  return count > 0;
}

/// Confirms loads by counts where the search could not: next to a load at which elements alone buckle, counts
/// lose their digits, and where parts are stiffer than others by 1e14, quotients do.
bool are_confirmed(BucklingPencil& pencil, const VectorXd& loads, const MatrixXd& modes, int below) {
  const auto counted_at = [&](double distance) { return are_counted(pencil, loads, below, distance); };
  return std::ranges::any_of(BucklingLimits::counted, counted_at) ||
         (have_their_quotients(pencil, loads, modes) && counted_at(BucklingLimits::farther));
}

/// Appends the lowest `count` loads above a shift, which share their powers of ten with the lowest of them:
/// (J(load) - J(shift))^-1 loses what lies further away.
/// @param shift below the loads, with the inertia there
/// @param largest loads above it are rounding
/// @return whether the loads are confirmed
bool find_band(BucklingPencil& pencil, Shift shift, int count, double largest, KrylovColumns& columns,
               LinearBuckling& out) {
  const double from = shift.at;
  pencil.factorise(from);
  EigenSearch search;
  search.count = count;
  search.tolerance = BucklingLimits::tolerance;
  const Eigenpairs found = lowest_eigenpairs(pencil, shift, search, columns);
  VectorXd loads(static_cast<Index>(found.values.size()));
  for (Index i = 0; i < loads.size(); ++i) loads[i] = found.values[static_cast<std::size_t>(i)].real();
  MatrixXd modes = found.vectors;
  bool are_loads = found.complete && found.converged;
  if (loads.size() > 0 && !have_their_quotients(pencil, loads, modes))
    are_loads = settle(pencil, shift.at, loads, modes) && have_their_quotients(pencil, loads, modes) &&
                are_counted(pencil, loads, shift.below, BucklingLimits::same);
  are_loads = are_loads || are_confirmed(pencil, loads, modes, shift.below);
  for (Index i = 0; i < loads.size(); ++i) {
    if (!(loads[i] > from && loads[i] < largest)) continue;
    out.loads.push_back(loads[i]);
    out.modes.emplace_back(modes.col(i) / modes.col(i).lpNorm<Eigen::Infinity>());
  }
  return are_loads;
}

/// Last doubling of a load factor with the same inertia; empty where a load lies within the first one.
std::optional<double> last_with(BucklingPencil& pencil, int inertia, double from, double largest) {
  for (double at = from; at < largest; at *= 2.0)
    if (pencil.factorise(at) != inertia) return at > from ? std::optional(0.5 * at) : std::nullopt;
  return std::nullopt;
}

/// The lowest `count` loads of the pencil with its present contact.
void find_loads(BucklingPencil& pencil, int count, LinearBuckling& out) {
  out.loads.clear();
  out.modes.clear();
  out.negative_at_start = pencil.factorise(0.0);
  pencil.set_stable_at_start(out.negative_at_start == 0);
  const LoadRange range = range_of_first(pencil, out.negative_at_start);
  if (range.lowest == 0.0) return;
  KrylovColumns columns;
  const auto all = [&out] { return static_cast<int>(out.loads.size()); };
  const auto is_last = [&] {
    return all() >= count || pencil.factorise(range.largest) == out.negative_at_start + all();
  };
  std::optional<double> from = range.lowest;
  do {
    const int before = all();
    out.complete = find_band(pencil, {*from, out.negative_at_start + before}, count - before, range.largest,
                             columns, out);
    if (is_last()) return;
    // where the start is unstable, counts do not tell the loads that are left
    out.complete = out.complete && all() > before && out.negative_at_start == 0;
    if (!out.complete) return;
    from = last_with(pencil, out.negative_at_start + all(), kOffMultiples * out.loads.back(), range.largest);
  } while (from);
  out.complete = false;
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
  out.touches = structure.traits.one_sided && structure.free_motions.cols() == 0 && has_any(marks);
  if (out.touches) out.piece = set_least_piece(problem, solver_of(pencil), marks, near, pencil.contact());
  find_loads(pencil, count, out);
  for (const double load : out.loads)
    out.compressions.push_back(compressions_of(structure, pencil.stress(load)));
  if (structure.traits.has_curves && !out.loads.empty()) out.prestress = pencil.stress(out.loads.front());
  out.factorizations = pencil.factorizations();
  out.marks = marks;
  out.contact = std::move(pencil.contact());
  return out;
}

std::optional<VectorXd> small_displacement_state(StructuralProblem& problem, double lambda,
                                                 int& factorizations) {
  const PathMetric metric{&problem.metric(), 0.0};
  Workspace work;
  problem.set_holds(held_softly(problem));
  const auto state = find_contact_state(problem, metric, lambda, work, factorizations, nullptr, true);
  return state ? std::optional(state->y) : std::nullopt;
}

std::optional<FrozenContact> linear_contact(StructuralProblem& problem, double lambda, int& factorizations) {
  const auto state = small_displacement_state(problem, lambda, factorizations);
  return state ? std::optional(problem.contact().frozen(*state, true)) : std::nullopt;
}

}  // namespace snapthrough
