#include "solver/events/flutter.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "solver/discrete/follower_parts.h"
#include "solver/events/damped_motions.h"
#include "solver/path/segment.h"

namespace snapthrough {
namespace {

using Squares = std::vector<std::complex<double>>;

/// Limits of the search for flutter; ratios unless said otherwise.
struct FlutterLimits {
  static constexpr int tracked = 8;           ///< number of eigenvalues that are watched
  static constexpr double tolerance = 1e-10;  ///< relative accuracy of the natural motions
  static constexpr double real = 1e-6;        ///< imaginary part of an eigenvalue that counts as rounding
  /// Distance of a function in the middle of a step from the mean of the ends, over its value there (over the
  /// larger end where the sign changes), beyond which the step is halved.
  static constexpr double bend = 0.1;
  static constexpr double straight = 1e-3;  ///< such a distance over the magnitude that needs no halving
  /// A step that needs more halvings is too long. Two sides of a place at which a support begins to act are
  /// bisected down to the shortest piece, by some 40.
  static constexpr int halvings = 64;
  static constexpr Eigen::Index forces = 4;  ///< combinations of the forces of a part, see follower_parts()
  /// Where supports touch without pressure as a step begins, its first share, which is left out.
  static constexpr double beginning = 1e-3;
  static constexpr double shortest = 1e-6;  ///< length of a step that is not halved, over its load
  static constexpr int places = 4;          ///< pieces of a step at whose ends divergence_on_step() looks
};

bool is_real(const std::complex<double>& square) {
  return std::abs(square.imag()) <= FlutterLimits::real * std::abs(square);
}

int pairs_in(const Squares& squares) {
  return static_cast<int>(std::count_if(squares.begin(), squares.end(), [](const auto& square) {
    return square.imag() > 0.0 && !is_real(square);
  }));
}

/// Mean and squared half difference of two eigenvalues: both are real, and smooth where the two meet.
struct Pair {
  double mean = 0.0;
  double difference = 0.0;
  std::size_t first = 0;  ///< index of the lower eigenvalue
};

Pair pair_at(const Squares& squares, std::size_t i) {
  const std::complex<double> half = 0.5 * (squares[i + 1] - squares[i]);
  return {0.5 * (squares[i] + squares[i + 1]).real(), (half * half).real(), i};
}

/// The pair nearest to a mean, among adjacent eigenvalues.
Pair nearest(const Squares& squares, double mean) {
  Pair best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < squares.size(); ++i) {
    const Pair pair = pair_at(squares, i);
    const double apart = (pair.mean - mean) * (pair.mean - mean) + std::abs(pair.difference);
    if (apart < least) {
      least = apart;
      best = pair;
    }
  }
  return best;
}

/// The pair that is complex at `to` and has no counterpart at `from`: the one farthest from those there.
Pair new_pair(const Squares& from, const Squares& to) {
  Pair best;
  double most = -1.0;
  for (std::size_t i = 0; i + 1 < to.size(); ++i) {
    if (is_real(to[i]) || to[i + 1] != std::conj(to[i])) continue;
    const Pair pair = pair_at(to, i);
    double apart = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < from.size(); ++k)
      if (!is_real(from[k]) && from[k + 1] == std::conj(from[k]))
        apart = std::min(apart, std::abs(pair_at(from, k).mean - pair.mean));
    if (apart > most) {
      most = apart;
      best = pair;
    }
  }
  return best;
}

/// Real eigenvalues below zero: motions that diverge.
int diverging(const Squares& squares) {
  return static_cast<int>(std::count_if(squares.begin(), squares.end(), [](const auto& square) {
    return square.real() < 0.0 && is_real(square);
  }));
}

/// Whether a smooth function may have zeros on a step that the signs at its ends do not show.
/// @param scale magnitude of the function away from its zeros
bool may_hide_zeros(double from, double middle, double to, double scale) {
  const bool same = (from > 0.0) == (to > 0.0);
  if (same && (middle > 0.0) != (from > 0.0)) return true;
  const double size = same ? std::abs(middle) : std::max(std::abs(from), std::abs(to));
  const double off = std::abs(middle - 0.5 * (from + to));
  return off > std::max(FlutterLimits::bend * size, FlutterLimits::straight * scale);
}

/// Whether eigenvalues may have met, or one may have passed zero, where the ends of a step do not show it.
bool bends(const Squares& from, const Squares& middle, const Squares& to) {
  const std::size_t n = std::min({from.size(), middle.size(), to.size()});
  if (std::abs(diverging(from) - diverging(to)) > 1) return true;
  for (std::size_t i = 0; i < n; ++i)
    if (may_hide_zeros(from[i].real(), middle[i].real(), to[i].real(), std::abs(middle[i]))) return true;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Pair pair = pair_at(middle, i);
    if (may_hide_zeros(pair_at(from, i).difference, pair.difference, pair_at(to, i).difference,
                       pair.mean * pair.mean))
      return true;
  }
  return false;
}

/// Whether the loads of a bracket agree.
auto closed_by_load(double tolerance) {
  return [tolerance](const PathPoint& a, const PathPoint& b, double) {
    return std::abs(a.lambda - b.lambda) <= tolerance * std::max(std::abs(a.lambda), std::abs(b.lambda));
  };
}

}  // namespace

FlutterSearch::FlutterSearch(const Structure& structure, StructuralProblem::Stage stage)
    : problem_(structure),
      structure_(structure),
      model_(*structure.model),
      masses_(make_mass_matrix(structure)) {
  problem_.set_stage(stage);
  for (Eigen::MatrixXd& forces : follower_parts(structure, FlutterLimits::forces)) {
    Part& part = parts_.emplace_back();
    part.search.count = FlutterLimits::tracked;
    part.search.tolerance = FlutterLimits::tolerance;
    part.search.counted = false;
    part.search.forces = std::move(forces);
    part.left = part.search;
  }
  if (has_massless_elements(masses_)) massless_.emplace(structure, masses_, stage);
}

FlutterSearch::Sample FlutterSearch::sample(Part& part, const PathPoint& point) {
  Sample out{point,
             natural_motions(structure_, problem_, masses_, point.y, point.lambda, part.search, columns_),
             0,
             {}};
  part.search.begin_with(out.motions);
  out.pairs = pairs_in(out.motions.squares);
  if (!is_damped(model_.damping)) return out;
  problem_.set_transposed(true);
  const NaturalMotions left =
      natural_motions(structure_, problem_, masses_, point.y, point.lambda, part.left, columns_);
  problem_.set_transposed(false);
  part.left.begin_with(left);
  if (left.motions.cols() == out.motions.motions.cols())
    out.growing = most_growing(structure_, masses_, out.motions, left);
  return out;
}

bool FlutterSearch::grows(const Sample& at) const {
  return is_damped(model_.damping) ? at.growing.growth > 0.0 : at.pairs > 0;
}

bool FlutterSearch::flutters_at(const PathPoint& point) {
  return std::ranges::any_of(parts_, [&](Part& part) { return grows(sample(part, point)); });
}

/// The first point of a step at which natural motions are those of the step.
PathPoint FlutterSearch::beginning(PointSolver& solver, const PathPoint& from, const PathPoint& to) const {
  if (!structure_.traits.one_sided || !has_any(problem_.contact().marks_at(from.y))) return from;
  return Segment(solver, from, to).point_at(FlutterLimits::beginning).value_or(from);
}

StepVibrations FlutterSearch::on_step(PointSolver& solver, const PathPoint& from, const PathPoint& to,
                                      double tolerance) {
  const PathPoint begin = beginning(solver, from, to);
  StepVibrations out;
  const auto add = [&out](std::optional<CriticalEvent> found) {
    if (found && (!out.loss || found->point.arc_length < out.loss->point.arc_length))
      out.loss = std::move(found);
  };
  for (Part& part : parts_) {
    add(in_part(part, solver, begin, to, tolerance));
    out.is_too_long = too_long_;
    if (too_long_) return {{}, true};
  }
  if (massless_) add(massless_->on_step(solver, begin, to, largest_square(), tolerance));
  return out;
}

/// The largest of the eigenvalues that were found last.
double FlutterSearch::largest_square() const {
  double largest = masses_.scale;
  for (const Part& part : parts_)
    for (const auto& square : part.last->motions.squares) largest = std::max(largest, std::abs(square));
  return largest;
}

std::optional<CriticalEvent> FlutterSearch::in_part(Part& part, PointSolver& solver, const PathPoint& from,
                                                    const PathPoint& to, double tolerance) {
  const bool is_known = part.last && part.last->point.lambda == from.lambda && part.last->point.y == from.y;
  const Sample first = is_known ? *std::move(part.last) : sample(part, from);
  const Sample second = sample(part, to);
  too_long_ = false;
  halvings_ = 0;
  auto out = between(part, solver, first, second, tolerance);
  part.last = too_long_ ? first : second;
  return out;
}

/// Searches a piece of the path for flutter, in halves as long as its eigenvalues bend.
std::optional<CriticalEvent> FlutterSearch::between(Part& part, PointSolver& solver, const Sample& from,
                                                    const Sample& to, double tolerance) {
  const double width = std::abs(to.point.lambda - from.point.lambda);
  if (width <= FlutterLimits::shortest * std::max(std::abs(to.point.lambda), std::abs(from.point.lambda)))
    return on_piece(part, solver, from, to, tolerance);
  const auto point = Segment(solver, from.point, to.point).point_at(0.5);
  if (!point) return on_piece(part, solver, from, to, tolerance);
  const Sample middle = sample(part, *point);
  const auto is_odd = [](int difference) { return difference % 2 != 0; };
  too_long_ =
      !is_odd(to.point.negative - from.point.negative) && is_odd(point->negative - from.point.negative);
  if (too_long_) return std::nullopt;
  if (!bends(from.motions.squares, middle.motions.squares, to.motions.squares))
    return on_piece(part, solver, from, to, tolerance);
  too_long_ = ++halvings_ > FlutterLimits::halvings;
  if (too_long_) return std::nullopt;
  if (auto found = between(part, solver, from, middle, tolerance)) return found;
  return too_long_ ? std::nullopt : between(part, solver, middle, to, tolerance);
}

/// Searches a piece of the path on which no eigenvalues meet but where the ends show it.
std::optional<CriticalEvent> FlutterSearch::on_piece(Part& part, PointSolver& solver, const Sample& from,
                                                     const Sample& to, double tolerance) {
  if (is_damped(model_.damping))
    return !grows(from) && grows(to) ? locate_growth(part, solver, from, to, tolerance) : std::nullopt;
  return to.pairs > from.pairs ? locate(part, solver, from, to, tolerance) : std::nullopt;
}

StepVibrations divergence_on_step(PointSolver& solver, const PathPoint& from, const PathPoint& to) {
  StepVibrations out;
  if (from.negative != to.negative) return out;
  const Segment segment(solver, from, to);
  for (int i = 1; i < FlutterLimits::places && !out.is_too_long; ++i) {
    const auto point = segment.point_at(static_cast<double>(i) / FlutterLimits::places);
    out.is_too_long = point && (point->negative - from.negative) % 2 != 0;
  }
  return out;
}

/// Critical point of type flutter at a root. Its motion belongs to the pair of eigenvalues omega^2 whose mean
/// is nearest to `mean`; with damping, to the pair nearest to |s|^2, where exp(s t) is the vibration that
/// grows most.
/// @return empty where fewer than two natural motions are found at the root; the step then counts as too long
std::optional<CriticalEvent> FlutterSearch::event_at(Part& part, const LocatedRoot& root, double mean) {
  CriticalEvent event;
  event.type = CriticalType::flutter;
  event.point = root.root;
  // the zero is nearer than the bracket is wide, and other meshes have it a little beside
  const double fall = root.value_before - root.value_after;
  const double share = fall != 0.0 ? root.value_before / fall : 0.5;
  event.point.y = root.before.y + share * (root.after.y - root.before.y);
  event.point.lambda = root.before.lambda + share * (root.after.lambda - root.before.lambda);
  event.multiplicity = 2;
  event.bracket_loads[0] = root.before.lambda;
  event.bracket_loads[1] = root.after.lambda;
  const Sample at = sample(part, event.point);
  const Squares& squares = at.motions.squares;
  too_long_ = squares.size() < 2;
  if (too_long_) return std::nullopt;
  const Pair pair = nearest(squares, is_damped(model_.damping) ? at.growing.square : mean);
  event.null = at.motions.motions.col(static_cast<Eigen::Index>(pair.first));
  return event;
}

std::optional<CriticalEvent> FlutterSearch::locate_growth(Part& part, PointSolver& solver, const Sample& from,
                                                          const Sample& to, double tolerance) {
  const RootFunction function{[&](const PathPoint& at) { return sample(part, at).growing.growth; },
                              closed_by_load(tolerance)};
  const LocatedRoot root =
      find_root(Segment(solver, from.point, to.point), from.growing.growth, to.growing.growth, function);
  too_long_ = !root.found;
  if (too_long_) return std::nullopt;
  return event_at(part, root, 0.0);
}

std::optional<CriticalEvent> FlutterSearch::locate(Part& part, PointSolver& solver, const Sample& from,
                                                   const Sample& to, double tolerance) {
  const Pair beyond = new_pair(from.motions.squares, to.motions.squares);
  const Pair before = nearest(from.motions.squares, beyond.mean);
  double mean = beyond.mean;
  const RootFunction function{[&](const PathPoint& at) {
                                const Pair pair = nearest(sample(part, at).motions.squares, mean);
                                mean = pair.mean;
                                return pair.difference;
                              },
                              closed_by_load(tolerance)};
  const LocatedRoot root =
      find_root(Segment(solver, from.point, to.point), before.difference, beyond.difference, function);
  too_long_ = !root.found;
  if (too_long_) return std::nullopt;
  return event_at(part, root, mean);
}

}  // namespace snapthrough
