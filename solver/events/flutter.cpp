#include "solver/events/flutter.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

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
  static constexpr int halvings = 5;        ///< a step that needs more of them is too long
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

FlutterSearch::FlutterSearch(const Structure& structure, const Model& model)
    : problem_(structure), structure_(structure), model_(model), masses_(make_mass_matrix(structure, model)) {
  search_.count = FlutterLimits::tracked;
  search_.tolerance = FlutterLimits::tolerance;
  search_.counted = false;
  left_ = search_;
}

FlutterSearch::Sample FlutterSearch::sample(const PathPoint& point) {
  Sample out{
      point, natural_motions(structure_, problem_, masses_, point.y, point.lambda, search_, columns_), 0, {}};
  search_.begin_with(out.motions);
  out.pairs = pairs_in(out.motions.squares);
  if (!is_damped(model_.damping)) return out;
  problem_.set_transposed(true);
  const NaturalMotions left =
      natural_motions(structure_, problem_, masses_, point.y, point.lambda, left_, columns_);
  problem_.set_transposed(false);
  left_.begin_with(left);
  if (left.motions.cols() == out.motions.motions.cols())
    out.growing = most_growing(structure_, model_, masses_, out.motions, left);
  return out;
}

StepVibrations FlutterSearch::on_step(PointSolver& solver, const PathPoint& from, const PathPoint& to,
                                      double tolerance) {
  const bool is_known = last_ && last_->point.lambda == from.lambda && last_->point.y == from.y;
  const Sample first = is_known ? *std::move(last_) : sample(from);
  const Sample second = sample(to);
  too_long_ = false;
  StepVibrations out;
  out.flutter = between(solver, first, second, tolerance, 0);
  out.is_too_long = too_long_;
  last_ = too_long_ ? first : second;
  return out;
}

/// Searches a piece of the path for flutter, in halves as long as its eigenvalues bend.
std::optional<CriticalEvent> FlutterSearch::between(PointSolver& solver, const Sample& from, const Sample& to,
                                                    double tolerance, int depth) {
  const auto here = [&]() -> std::optional<CriticalEvent> {
    if (is_damped(model_.damping))
      return from.growing.growth <= 0.0 && to.growing.growth > 0.0
                 ? locate_growth(solver, from, to, tolerance)
                 : std::nullopt;
    return to.pairs > from.pairs ? locate(solver, from, to, tolerance) : std::nullopt;
  };
  const double width = std::abs(to.point.lambda - from.point.lambda);
  if (width <= FlutterLimits::shortest * std::max(std::abs(to.point.lambda), std::abs(from.point.lambda)))
    return here();
  const auto point = Segment(solver, from.point, to.point).point_at(0.5);
  if (!point) return here();
  const Sample middle = sample(*point);
  const auto is_odd = [](int difference) { return difference % 2 != 0; };
  too_long_ =
      !is_odd(to.point.negative - from.point.negative) && is_odd(point->negative - from.point.negative);
  if (too_long_) return std::nullopt;
  if (!bends(from.motions.squares, middle.motions.squares, to.motions.squares)) return here();
  too_long_ = depth == FlutterLimits::halvings;
  if (too_long_) return std::nullopt;
  if (auto found = between(solver, from, middle, tolerance, depth + 1)) return found;
  return too_long_ ? std::nullopt : between(solver, middle, to, tolerance, depth + 1);
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
std::optional<CriticalEvent> FlutterSearch::event_at(const LocatedRoot& root, double mean) {
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
  const Sample at = sample(event.point);
  const Squares& squares = at.motions.squares;
  too_long_ = squares.size() < 2;
  if (too_long_) return std::nullopt;
  const Pair pair = nearest(squares, is_damped(model_.damping) ? at.growing.square : mean);
  event.null = at.motions.motions.col(static_cast<Eigen::Index>(pair.first));
  return event;
}

std::optional<CriticalEvent> FlutterSearch::locate_growth(PointSolver& solver, const Sample& from,
                                                          const Sample& to, double tolerance) {
  const RootFunction function{[&](const PathPoint& at) { return sample(at).growing.growth; },
                              closed_by_load(tolerance)};
  const LocatedRoot root =
      find_root(Segment(solver, from.point, to.point), from.growing.growth, to.growing.growth, function);
  too_long_ = !root.found;
  if (too_long_) return std::nullopt;
  return event_at(root, 0.0);
}

std::optional<CriticalEvent> FlutterSearch::locate(PointSolver& solver, const Sample& from, const Sample& to,
                                                   double tolerance) {
  const Pair beyond = new_pair(from.motions.squares, to.motions.squares);
  const Pair before = nearest(from.motions.squares, beyond.mean);
  double mean = beyond.mean;
  const RootFunction function{[&](const PathPoint& at) {
                                const Pair pair = nearest(sample(at).motions.squares, mean);
                                mean = pair.mean;
                                return pair.difference;
                              },
                              closed_by_load(tolerance)};
  const LocatedRoot root =
      find_root(Segment(solver, from.point, to.point), before.difference, beyond.difference, function);
  too_long_ = !root.found;
  if (too_long_) return std::nullopt;
  return event_at(root, mean);
}

}  // namespace snapthrough
