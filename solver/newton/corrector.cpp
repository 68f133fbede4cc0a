#include "solver/newton/corrector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snapthrough {

namespace {

/// One bordered Newton correction with the factors at hand, in work.correction; returns its part in lambda.
double find_correction(EquilibriumProblem& problem, const SideCondition& side, const Eigen::VectorXd& y,
                       double lambda, Workspace& work) {
  work.correction = -work.residual;
  problem.solve(work.correction);
  problem.load(y, lambda, work.load_response);
  problem.solve(work.load_response);
  double along = 0.0;
  double denominator = side.normal_lambda;
  if (side.normal.size() > 0) {
    along = side.normal.dot(work.correction);
    denominator += side.normal.dot(work.load_response);
  }
  const double dlambda = -along / denominator;
  work.correction += dlambda * work.load_response;
  return dlambda;
}

/// Relative residual, over the tangent's tolerance, that the last correction may start from.
constexpr double kNearResidual = 10.0;

/// With contact that changes corrections may cycle: one that is the last for the tangent's sake is at most
/// this share of the one before.
constexpr double kClosingShare = 0.1;

/// Corrections before a residual that no longer falls counts as rounding's, and what is left of one that
/// does not.
constexpr int kStagnantIterations = 4;
constexpr double kStagnantShare = 0.5;
/// Corrections (displacement gradients; share of the step) beyond which a residual is not rounding's, however
/// small it is beside large forces, but that of contact which cycles.
constexpr double kLargestRounding = 1e-6;
constexpr double kLargestRoundingShare = 1e-4;
/// The same for a correction that is not taken.
constexpr double kLargestLeft = 1e-8;

/// Share of the correction at which the forces do no work on it any more. At a given load and small
/// displacements one-sided supports have a convex energy, of which this is the least along the correction:
/// so Newton's method can't cycle between contact patterns.
double least_energy(EquilibriumProblem& problem, const Regime& regime, const Eigen::VectorXd& y,
                    double lambda, Workspace& work) {
  constexpr int kMostTrials = 12;
  constexpr double kWorkLeft = 0.1;
  constexpr double kEnough = 0.5;
  constexpr double kLongest = 64.0;
  const double at_start = work.residual.dot(work.correction);
  if (!(at_start < 0.0)) return 1.0;
  const auto work_at = [&](double share) {
    work.trial = y + share * work.correction;
    problem.residual(work.trial, lambda, work.residual, regime);
    return work.residual.dot(work.correction);
  };
  double low = 0.0;
  double high = 1.0;
  double work_low = at_start;
  double work_high = work_at(1.0);
  // where contact is lost along the correction, the structure is softer than its tangent: further
  while (work_high < kWorkLeft * at_start && high < kLongest) {
    low = high;
    work_low = work_high;
    high *= 2.0;
    work_high = work_at(high);
  }
  if (!(work_high > -kEnough * at_start)) return high;
  for (int i = 0; i < kMostTrials; ++i) {
    const double share = std::clamp(low - work_low * (high - low) / (work_high - work_low),
                                    low + 0.05 * (high - low), high - 0.05 * (high - low));
    const double at = work_at(share);
    if (std::abs(at) <= -kWorkLeft * at_start) return share;
    (at < 0.0 ? low : high) = share;
    (at < 0.0 ? work_low : work_high) = at;
  }
  return low > 0.0 ? low : high;
}

/// Takes the last correction. Where supports act on one side only it may cross to other contact, where the
/// factors say nothing: then the point stays, if it is good enough as it is. The factors may also have lost
/// digits, where a part of a member is at a buckling load of its own.
/// @param exact whether another may follow that leaves less than this one
/// @return false when neither is
bool take_last(EquilibriumProblem& problem, const CorrectorOptions& options, bool exact, Eigen::VectorXd& y,
               double& lambda, double dlambda, double correction, const CorrectorOutcome& out,
               Workspace& work) {
  work.trial = y + work.correction;
  if (exact || problem.one_sided()) {
    problem.residual(work.trial, lambda + dlambda, work.residual, options.regime);
    const double size = problem.relative_residual(work.residual, work.trial, lambda + dlambda);
    const double rounding = std::max(kResidualFloor, problem.residual_rounding(work.trial, lambda + dlambda));
    const double most = std::min(out.relative_residual, options.largest_residual);
    if (problem.one_sided() && size > std::max(most, rounding))
      return correction <= kLargestLeft && out.relative_residual <= options.stagnant_residual;
    // one that leaves more was not the last, but where residuals are smooth and no longer fall
    const bool falls = problem.one_sided() || size <= kStagnantShare * out.relative_residual;
    if (exact && falls && size > rounding) return false;
  }
  y.swap(work.trial);
  lambda += dlambda;
  return true;
}

/// What the corrections so far tell of the next.
class Progress {
 public:
  Progress(const CorrectorOptions& options, double scale)
      : options_(options),
        scale_(scale),
        displacement_(std::min(scale, options.displacement)),
        previous_(scale) {}

  /// Whether the correction of this size, before which the residual is `residual`, is the last.
  [[nodiscard]] bool is_last(int iteration, double size, double residual) {
    // quadratic convergence, as the correction before let it expect and as this one does
    const bool small =
        std::max(expected_, size * ratio(size) * ratio(size)) <= options_.tolerance * displacement_ &&
        residual <= options_.largest_residual;
    const bool rounding = residual <= kRoundingResidual ||
                          size <= std::min(kLargestRounding, kLargestRoundingShare * displacement_);
    stagnant_ = iteration >= kStagnantIterations && residual <= options_.stagnant_residual &&
                residual > kStagnantShare * last_residual_;
    last_residual_ = residual;
    return iteration > 0 && (small || (rounding && (stagnant_ || residual <= kResidualFloor)));
  }
  /// Whether the first correction is rounding's, however large it is where the tangent is nearly singular.
  [[nodiscard]] bool is_rounding(int iteration, double size, double residual) const {
    return iteration == 0 && residual <= kRoundingResidual && size > options_.tangent_tolerance * scale_;
  }
  /// Whether corrections converge, and do not merely happen to be small.
  [[nodiscard]] bool closes_in(double size) const { return size <= kClosingShare * previous_; }
  /// Whether the residual no longer falls, as is_last() found.
  [[nodiscard]] bool stagnant() const { return stagnant_; }
  /// Whether the first correction or its growth shows that the predictor said nothing.
  [[nodiscard]] bool runs_away(int iteration, double size) const {
    return size > (iteration == 0 ? options_.largest_first * scale_ : options_.largest_growth * previous_);
  }
  /// Takes in a correction of which `share` was taken; false when too many did not shrink.
  [[nodiscard]] bool goes_on(double size, double share, double residual) {
    // near rounding nothing falls
    if (size > kStagnantShare * least_ && residual > options_.stagnant_residual) ++stalled_;
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

/// Whether what the corrections left is what the supports' rounding leaves anyway.
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
    const double size = metric.norm(work.correction, dlambda);
    if (!std::isfinite(size)) return out;
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
                      residual <= kNearResidual * options.tangent_tolerance;
    const bool exact = options.tangent_tolerance == 0.0 && !progress.stagnant();
    if ((last || near) && take_last(problem, options, exact, y, lambda, dlambda, size, out, work)) {
      out.status = CorrectorStatus::converged;
      return out;
    }
    const double share = options.least_energy ? least_energy(problem, options.regime, y, lambda, work) : 1.0;
    y += share * work.correction;
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
