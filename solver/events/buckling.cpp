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
using Eigen::VectorXd;

/// Limits of the eigenvalue search; loads are relative. Source: digits of the counts, docs/decisions/0001.
struct BucklingLimits {
  static constexpr double short_bracket = 1e-2;   ///< width at which iterations gain two digits each
  static constexpr double narrow_bracket = 1e-4;  ///< width at which several loads count as a cluster
  static constexpr int tries = 3;                 ///< shifts that draw_up() tries
  static constexpr int iterations_per_try = 3;    ///< inverse iterations on each shift of draw_up()
  static constexpr double below = 2e-3;           ///< distance of the shift below the load, see refine()
  static constexpr double converged = 1e-13;  ///< change of a load at which inverse iteration ends: rounding
  static constexpr int most_iterations = 60;  ///< inverse iterations at most
  static constexpr double beside = 1e-9;      ///< distance from a load of the counts that confirm it
  static constexpr double held_share = 1e-3;  ///< digits of LinearBuckling::held_share
  /// Doublings of the first scale; beyond 1e13 times it the elastic stiffness is lost to rounding.
  static constexpr int doublings = 43;
};

using Pencil = BucklingPencil;

/// Short brackets of single eigenvalues and narrow brackets of clusters, ascending.
std::vector<LoadBracket> isolated(Pencil& pencil, const LoadBracket& all, int wanted) {
  std::vector<LoadBracket> out;
  const auto take = [&](const LoadBracket& bracket) {
    const bool single = bracket.is_single();
    // a single wanted load may have a wide bracket, because no other load in it can be confused with it
    const bool only = single && out.empty() && bracket.below_hi == wanted;
    if (!only && bracket.hi - bracket.lo >
                     (single ? BucklingLimits::short_bracket : BucklingLimits::narrow_bracket) * bracket.hi)
      return false;
    // eigenvalues in adjacent brackets form one cluster
    if (!out.empty() && out.back().hi == bracket.lo) {
      out.back().hi = bracket.hi;
      out.back().below_hi = bracket.below_hi;
    } else {
      out.push_back(bracket);
    }
    return true;
  };
  isolate_loads(
      all, wanted, [&](double load) { return pencil.count(load); }, take);
  return out;
}

struct EigenPair {
  double load = 0.0;
  VectorXd mode;
};

/// Rayleigh-Ritz on the span of y, where J(shift) y_j = b_j: (y^T b) c = (shift - lambda) (y^T G y) c.
std::vector<EigenPair> ritz(Pencil& pencil, double shift, const std::vector<VectorXd>& y,
                            const std::vector<VectorXd>& b) {
  const auto m = static_cast<Index>(y.size());
  Eigen::MatrixXd left(m, m);
  Eigen::MatrixXd right(m, m);
  for (Index j = 0; j < m; ++j) {
    const VectorXd gy = pencil.geometric(y[j]);
    for (Index i = 0; i < m; ++i) {
      left(i, j) = y[i].dot(b[j]);
      right(i, j) = y[i].dot(gy);
    }
  }
  const RealEigen found = real_eigen(solve_row_pivoting(left, right));
  std::vector<EigenPair> pairs;
  for (Index k = 0; k < m; ++k) {
    VectorXd mode = VectorXd::Zero(y[0].size());
    for (Index j = 0; j < m; ++j) mode += found.vectors(j, k) * y[j];
    pairs.push_back({shift - 1.0 / found.values[k], mode / mode.lpNorm<Eigen::Infinity>()});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const EigenPair& l, const EigenPair& r) { return l.load < r.load; });
  return pairs;
}

/// One step of block inverse iteration with the current factors. @return largest relative change of a load
double iterate(Pencil& pencil, double shift, std::vector<EigenPair>& pairs) {
  std::vector<VectorXd> b;
  std::vector<VectorXd> y;
  for (const EigenPair& pair : pairs) {
    b.push_back(pencil.geometric(pair.mode));
    y.push_back(b.back());
    pencil.solve(y.back());
  }
  auto next = ritz(pencil, shift, y, b);
  double change = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    change = std::max(change, std::abs(next[i].load / pairs[i].load - 1.0));
  pairs = std::move(next);
  return change;
}

/// Raises the lower end of a wide bracket of one load to 0.2 % below an estimate by inverse iteration, and
/// confirms the new end by an inertia count. True: confirmed, and the pencil is factorised there.
bool draw_up(Pencil& pencil, LoadBracket& bracket, std::vector<EigenPair>& pairs) {
  for (int i = 0; i < BucklingLimits::tries; ++i) {
    if (pencil.count(bracket.lo) != bracket.below_lo) return false;
    for (int k = 0; k < BucklingLimits::iterations_per_try; ++k) iterate(pencil, bracket.lo, pairs);
    const double load = pairs[0].load;
    if (!(load > bracket.lo && load < bracket.hi)) return false;  // another load is nearer to the shift
    const double shift = load * (1.0 - BucklingLimits::below);
    if (shift <= bracket.lo) return pencil.count(bracket.lo) == bracket.below_lo;
    if (pencil.count(shift) == bracket.below_lo) {
      bracket.lo = shift;
      return true;
    }
    bracket.hi = shift;
  }
  return false;
}

/// Bisects a bracket of one load until it is short enough for inverse iteration.
void narrow(Pencil& pencil, LoadBracket& bracket) {
  while (bracket.hi - bracket.lo > BucklingLimits::short_bracket * bracket.hi) {
    const double middle = 0.5 * (bracket.lo + bracket.hi);
    (pencil.count(middle) > bracket.below_lo ? bracket.hi : bracket.lo) = middle;
  }
}

/// Number of vectors for the lowest `wanted` eigenvalues of a cluster: the whole cluster if small, else min(2
/// wanted, wanted + 8) as usual for subspace iteration (Bathe, Finite Element Procedures, 11.6). Shear
/// buckling gives clusters of one mode per element.
int block_size(const LoadBracket& bracket, int wanted) {
  return std::min(bracket.below_hi - bracket.below_lo, std::min(2 * wanted, wanted + 8));
}

/// Block inverse iteration on one bracket.
/// @param wanted number of eigenvalues asked for
/// @return the lowest eigenvalues of the bracket, ascending, with their vectors
std::vector<EigenPair> refine(Pencil& pencil, LoadBracket& bracket, int wanted, Index size) {
  const int m = block_size(bracket, wanted);
  std::vector<EigenPair> pairs(static_cast<std::size_t>(m));
  for (int i = 0; i < m; ++i) pairs[i] = {bracket.hi, pseudo_random(size, static_cast<unsigned>(i + 1))};
  if (m == 1 && bracket.hi - bracket.lo > BucklingLimits::short_bracket * bracket.hi) {
    if (draw_up(pencil, bracket, pairs)) {
      for (int it = 0; it < BucklingLimits::most_iterations; ++it)
        if (iterate(pencil, bracket.lo, pairs) <= BucklingLimits::converged) break;
      return pairs;
    }
    narrow(pencil, bracket);
    pairs[0] = {bracket.hi, pseudo_random(size, 1U)};
  }
  // Shift below the bracket, where elimination is accurate even if parts of the structure buckle at the
  // bracket's load, if no other eigenvalue lies between; else a shift inside the bracket that bisection did
  // not use.
  double shift = bracket.lo - BucklingLimits::below * bracket.hi;
  if (pencil.count(shift) != bracket.below_lo) {
    shift = bracket.lo + 0.381966 * (bracket.hi - bracket.lo);
    static_cast<void>(pencil.count(shift));  // factorises at the shift
  }
  for (int it = 0; it < BucklingLimits::most_iterations; ++it)
    if (iterate(pencil, shift, pairs) <= BucklingLimits::converged && it > 0) break;
  return pairs;
}

/// Checks each load of a bracket by inertia counts on both sides. If they disagree, the load is kept where
/// the whole cluster was iterated and the Rayleigh quotient of its mode confirms it (counts lose digits next
/// to a double load); otherwise the load is located by bisection of the counts.
void confirm(Pencil& pencil, const LoadBracket& bracket, std::vector<EigenPair>& pairs) {
  const bool whole = static_cast<int>(pairs.size()) == bracket.below_hi - bracket.below_lo;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const int below = bracket.below_lo + static_cast<int>(i);
    const double load = pairs[i].load;
    const bool right = load > 0.0 && pencil.count(load * (1.0 - BucklingLimits::beside)) <= below &&
                       pencil.count(load * (1.0 + BucklingLimits::beside)) > below;
    const auto exact = [&] {
      return whole && load >= bracket.lo && load <= bracket.hi &&
             std::abs(pencil.quotient(pairs[i].mode) - load) <= BucklingLimits::beside * load;
    };
    if (!right && !exact())
      pairs[i].load = bisect(bracket.lo, bracket.hi, BucklingLimits::converged * bracket.hi,
                             [&](double at) { return pencil.count(at) > below; });
  }
}

/// Bracket from zero to a load factor with at least `count` eigenvalues below it; empty when there is none.
LoadBracket enclose(Pencil& pencil, int count, int at_start) {
  LoadBracket bracket{0.0, 0.0, at_start, at_start};
  double hi = pencil.scale();
  if (!std::isfinite(hi) || hi <= 0.0) hi = 1.0;
  hi *= kOffMultiples;
  for (int i = 0; i < BucklingLimits::doublings && bracket.below_hi - at_start < count; ++i) {
    bracket.hi = hi;
    bracket.below_hi = pencil.count(hi);
    hi *= 2.0;
  }
  return bracket;
}

/// The lowest `count` loads of the pencil with its present contact.
void find_loads(Pencil& pencil, Index size, int count, LinearBuckling& out) {
  out.loads.clear();
  out.modes.clear();
  out.negative_at_start = pencil.count(0.0);
  const LoadBracket all = enclose(pencil, count, out.negative_at_start);
  for (LoadBracket& bracket : isolated(pencil, all, out.negative_at_start + count)) {
    const int wanted = count - static_cast<int>(out.loads.size());
    auto pairs = refine(pencil, bracket, wanted, size);
    confirm(pencil, bracket, pairs);
    for (EigenPair& pair : pairs) {
      if (static_cast<int>(out.loads.size()) == count) break;
      if (!pair.mode.allFinite()) continue;  // spurious count by rounding: the mesh has no such mode
      out.loads.push_back(pair.load);
      out.modes.push_back(std::move(pair.mode));
    }
  }
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

PieceSolver solver_of(Pencil& pencil, Index size) {
  PieceSolver solver;
  solver.lowest = [&pencil, size]() -> std::optional<Piece> {
    LinearBuckling found;
    find_loads(pencil, size, 1, found);
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
  Pencil pencil(structure, problem, sense);
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
  if (out.touches)
    out.piece = set_least_piece(problem, solver_of(pencil, problem.size()), marks, near, pencil.contact());
  find_loads(pencil, problem.size(), count, out);
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
