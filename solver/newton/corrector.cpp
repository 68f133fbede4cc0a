#include "solver/newton/corrector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/numeric/rounding.h"

namespace snapthrough {

namespace {

/// Limits of Newton's method; ratios where no unit is given. Source: docs/decisions/0011 and 0022.
struct NewtonLimits {
  /// Largest residual, over the tangent tolerance, from which the last correction may start.
  static constexpr double near_residual = 10.0;
  /// Largest ratio of the last correction to the one before it; excludes cycles between contact states.
  static constexpr double closing = 0.1;
  static constexpr int stagnant_iterations = 4;  ///< corrections before stagnation is tested
  static constexpr double stagnant = 0.5;        ///< ratio of successive residuals above which they stagnate
  /// Largest correction (displacement gradient; share of the step) at which a residual counts as rounding.
  /// Larger corrections with a small residual come from cycles between contact states.
  static constexpr double rounding = 1e-6;
  static constexpr double rounding_share = 1e-4;
  static constexpr double omitted = 1e-8;  ///< largest correction, displacement gradient, that may be omitted
  static constexpr int search_trials = 12;  ///< trials of a line search at most
  static constexpr double work_left = 0.1;  ///< largest work after a line search, over that at its start
  /// Opposite work at the end of a correction, over that at its start, that requires a shorter one.
  static constexpr double overshoot = 0.5;
  static constexpr double longest = 64.0;  ///< largest factor on a correction
};

/// Computes one bordered Newton correction with the current factors into work.correction(); returns dlambda.
double find_correction(EquilibriumProblem& problem, const SideCondition& side, const Eigen::VectorXd& y,
                       double lambda, Workspace& work) {
  work.block.resize(y.size(), 2);
  problem.load(y, lambda, work.trial);
  work.correction() = -work.residual;
  work.load_response() = work.trial;
  problem.solve(work.block);
  double along = 0.0;
  double denominator = side.normal_lambda;
  if (side.normal.size() > 0) {
    along = side.normal.dot(work.correction());
    denominator += side.normal.dot(work.load_response());
  }
  const double dlambda = -along / denominator;
  work.correction() += dlambda * work.load_response();
  return dlambda;
}

/// Share of the correction at which the forces do no work along the correction. At fixed load and small
/// displacements the energy of one-sided supports is convex and least there, so that Newton's method cannot
/// cycle between contact states.
double least_energy(EquilibriumProblem& problem, const Regime& regime, const Eigen::VectorXd& y,
                    double lambda, Workspace& work) {
  const double at_start = work.residual.dot(work.correction());
  if (!(at_start < 0.0)) return 1.0;
  const auto work_at = [&](double share) {
    work.trial = y + share * work.correction();
    problem.residual(work.trial, lambda, work.residual, regime);
    return work.residual.dot(work.correction());
  };
  double low = 0.0;
  double high = 1.0;
  double work_low = at_start;
  double work_high = work_at(1.0);
  // contact lost along the correction makes the structure softer than its tangent: longer correction
  while (work_high < NewtonLimits::work_left * at_start && high < NewtonLimits::longest) {
    low = high;
    work_low = work_high;
    high *= 2.0;
    work_high = work_at(high);
  }
  if (!(work_high > -NewtonLimits::overshoot * at_start)) return high;
  for (int i = 0; i < NewtonLimits::search_trials; ++i) {
    const double share = std::clamp(low - work_low * (high - low) / (work_high - work_low),
                                    low + 0.05 * (high - low), high - 0.05 * (high - low));
    const double at = work_at(share);
    if (std::abs(at) <= -NewtonLimits::work_left * at_start) return share;
    (at < 0.0 ? low : high) = share;
    (at < 0.0 ? work_low : work_high) = at;
  }
  return low > 0.0 ? low : high;
}

/// Applies the last correction. With one-sided supports the correction may change the contact and thus leave
/// the range of the factors; the point then stays if its residual is small enough. The factors may also have
/// lost digits where a part of a member is near its own buckling load.
/// @param exact true: iteration may continue if that reduces the residual further
/// @return false when the correction must not be the last
bool take_last(EquilibriumProblem& problem, const CorrectorOptions& options, bool exact, Eigen::VectorXd& y,
               double& lambda, double dlambda, double correction, const CorrectorOutcome& out,
               Workspace& work) {
  work.trial = y + work.correction();
  if (exact || problem.traits().one_sided) {
    problem.residual(work.trial, lambda + dlambda, work.residual, options.regime);
    const double size = problem.relative_residual(work.residual, work.trial, lambda + dlambda);
    const double rounding =
        std::max(Rounding::largest_residual, problem.residual_rounding(work.trial, lambda + dlambda));
    const double most = std::min(out.relative_residual, options.largest_residual);
    if (problem.traits().one_sided && size > std::max(most, rounding))
      return correction <= NewtonLimits::omitted && out.relative_residual <= options.stagnant_residual;
    // a larger remainder requires another correction, unless residuals are smooth and no longer fall
    const bool falls = problem.traits().one_sided || size <= NewtonLimits::stagnant * out.relative_residual;
    if (exact && falls && size > rounding) return false;
  }
  y.swap(work.trial);
  lambda += dlambda;
  return true;
}

/// Decides from the sizes of the corrections whether Newton's method has converged or diverges.
class Progress {
 public:
  Progress(const CorrectorOptions& options, double scale)
      : options_(options),
        scale_(scale),
        displacement_(std::min(scale, options.displacement)),
        previous_(scale) {}

  /// The displacement within the step is at least that of a correction: a gap that closes moves a structure
  /// that the predictor leaves at rest.
  void has_moved(double displacement) {
    displacement_ = std::min(scale_, std::max(displacement_, displacement));
  }
  /// Whether a correction of norm `size`, computed at the relative residual `residual`, is the last.
  [[nodiscard]] bool is_last(int iteration, double size, double residual) {
    // predicted next correction under quadratic convergence
    const bool small =
        std::max(expected_, size * ratio(size) * ratio(size)) <= options_.tolerance * displacement_ &&
        residual <= options_.largest_residual;
    const bool rounding =
        residual <= kRoundingResidual ||
        size <= std::min(NewtonLimits::rounding, NewtonLimits::rounding_share * displacement_);
    stagnant_ = iteration >= NewtonLimits::stagnant_iterations && residual <= options_.stagnant_residual &&
                residual > NewtonLimits::stagnant * last_residual_;
    last_residual_ = residual;
    return iteration > 0 && (small || (rounding && (stagnant_ || residual <= Rounding::largest_residual)));
  }
  /// Whether the first correction is only rounding, amplified by a nearly singular tangent.
  [[nodiscard]] bool is_rounding(int iteration, double size, double residual) const {
    return iteration == 0 && residual <= kRoundingResidual && size > options_.tangent_tolerance * scale_;
  }
  /// Whether the corrections contract fast enough for the tangent tolerance.
  [[nodiscard]] bool closes_in(double size) const { return size <= NewtonLimits::closing * previous_; }
  /// Whether is_last() found that the residual no longer falls.
  [[nodiscard]] bool stagnant() const { return stagnant_; }
  /// Whether the first correction, or the growth of corrections, exceeds its bound.
  [[nodiscard]] bool runs_away(int iteration, double size) const {
    return size > (iteration == 0 ? options_.largest_first * scale_ : options_.largest_growth * previous_);
  }
  /// Records a correction that was applied by `share`; false after too many corrections that did not shrink.
  [[nodiscard]] bool goes_on(double size, double share, double residual) {
    // near rounding no correction shrinks
    if (size > NewtonLimits::stagnant * least_ && residual > options_.stagnant_residual) ++stalled_;
    least_ = std::min(least_, size);
    expected_ = share < 1.0 ? size : size * ratio(size) * ratio(size);
    previous_ = size;
    return stalled_ <= options_.most_stalled;
  }

 private:
  [[nodiscard]] double ratio(double size) const { return std::min(1.0, size / previous_); }

  const CorrectorOptions& options_;
  double scale_;
  double displacement_;
  double previous_;
  double expected_ = std::numeric_limits<double>::infinity();  ///< size of the next correction
  double last_residual_ = std::numeric_limits<double>::infinity();
  double least_ = std::numeric_limits<double>::infinity();
  int stalled_ = 0;
  bool stagnant_ = false;
};

/// Whether the residual is at most the rounding of the supports' forces.
bool settled_to_rounding(EquilibriumProblem& problem, const Regime& regime, const Eigen::VectorXd& y,
                         double lambda, CorrectorOutcome& out, Workspace& work) {
  problem.residual(y, lambda, work.residual, regime);
  const double size = problem.relative_residual(work.residual, y, lambda);
  if (!(size <= problem.residual_rounding(y, lambda))) return false;
  out.relative_residual = size;
  return true;
}

}  // namespace

CorrectorOutcome correct(EquilibriumProblem& problem, const PathMetric& metric, const SideCondition& side,
                         double scale, const CorrectorOptions& options, Eigen::VectorXd& y, double& lambda,
                         Workspace& work) {
  CorrectorOutcome out;
  Progress progress(options, scale);
  Regime first = options.regime;
  if (options.first_contact != nullptr) {
    first.contact = Regime::Contact::frozen;
    first.frozen = options.first_contact;
  }
  for (int it = 0; it < options.max_iterations; ++it) {
    out.tangent = problem.linearise(y, lambda, work.residual, it == 0 ? first : options.regime);
    ++out.factorisations;
    const double residual = problem.relative_residual(work.residual, y, lambda);
    out.relative_residual = residual;
    if (!std::isfinite(residual)) return out;
    const double dlambda = find_correction(problem, side, y, lambda, work);
    const double size = metric.norm(work.correction(), dlambda);
    if (!std::isfinite(size)) return out;
    if (std::isfinite(options.displacement)) progress.has_moved(metric.norm(work.correction(), 0.0));
    const bool last = progress.is_last(it, size, residual);
    if (it == 0) {
      out.first_correction = size;
      out.first_residual = residual;
    }
    if (progress.is_rounding(it, size, residual)) {
      out.status = CorrectorStatus::converged;
      return out;
    }
    if (progress.runs_away(it, size) && residual > options.stagnant_residual) return out;
    const bool near = size <= options.tangent_tolerance * scale && progress.closes_in(size) &&
                      residual <= NewtonLimits::near_residual * options.tangent_tolerance;
    const bool exact = options.tangent_tolerance == 0.0 && !progress.stagnant();
    if ((last || near) && take_last(problem, options, exact, y, lambda, dlambda, size, out, work)) {
      out.status = CorrectorStatus::converged;
      return out;
    }
    const double share = options.least_energy ? least_energy(problem, options.regime, y, lambda, work) : 1.0;
    y += share * work.correction();
    lambda += share * dlambda;
    if (size > options.largest_correction * scale) return out;
    if (!progress.goes_on(size, share, residual)) break;
  }
  out.status = settled_to_rounding(problem, options.regime, y, lambda, out, work)
                   ? CorrectorStatus::converged
                   : CorrectorStatus::too_many_iterations;
  return out;
}

}  // namespace snapthrough
