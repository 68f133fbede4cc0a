#include "solver/sensitivity/load_sensitivities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "solver/discrete/build_structure.h"
#include "solver/events/critical_sensitivity.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {
namespace {

using Eigen::MatrixXd;
using Rate = CriticalSensitivity::Rate;

/// Limits of the finite differences that give one rate: the derivative of a critical load factor by a number
/// of the model. A "change" is the rate times Variation::size, over the load factor. Source: error of a
/// second-order difference, see docs/theory.md.
struct DifferenceLimits {
  static constexpr int steps = 6;               ///< most step lengths that are tried
  static constexpr double first_step = 2.5e-4;  ///< first step over the variation's size
  static constexpr double shorter = 0.125;      ///< ratio of successive steps
  static constexpr double rounding = 1e-13;     ///< rounding of a load over the load
  static constexpr double agreement = 1e-6;     ///< error over the rate; its square after extrapolation
  static constexpr double no_change = 1e-8;     ///< error of the change that counts as zero
  static constexpr double rate_error = 1e-3;    ///< largest accepted error over the rate
  static constexpr double load_error = 1e-6;    ///< largest accepted error of the change
  /// Factor by which one-sided differences come closer, when the step is halved, where there is no kink.
  static constexpr double smooth_fall = 0.75;
  static constexpr double kink = 1e-5;            ///< mismatch of one-sided changes that is ignored
  static constexpr double breaking_share = 1e-5;  ///< work on the mode over its terms: rounding and mesh
  static constexpr double imperfection = 1e-9;    ///< imperfection by the variation that counts as zero
};

/// Derivative of the equations with respect to one variation, and the resulting sensitivity.
class VariationRate {
 public:
  /// @param here equations of the unchanged structure
  VariationRate(const Structure& structure, const CriticalEvent& event, const CriticalSensitivity& point,
                const MatrixXd& here, const Variation& variation,
                const std::function<ModeOffsets(const ResolvedModel&)>& offsets)
      : structure_(structure),
        event_(event),
        point_(point),
        here_(here),
        variation_(variation),
        offsets_(offsets) {}

  /// @param lambda scaled load factor of the point
  [[nodiscard]] Sensitivity find(double lambda);

 private:
  /// Equations at value -/+ step; one-sided differences: at half a step (`less`) and a whole step (`more`).
  struct Sides {
    MatrixXd less;
    MatrixXd more;
    double step = 0.0;
  };
  [[nodiscard]] std::optional<MatrixXd> equations_at(double value) const;
  [[nodiscard]] std::optional<Sides> sides(double step);
  [[nodiscard]] Rate difference(const Sides& at) const;
  [[nodiscard]] std::optional<Rate> best_difference(double lambda);
  [[nodiscard]] double mismatch(const Sides& at) const;
  [[nodiscard]] bool has_kink(double lambda) const;

  const Structure& structure_;
  const CriticalEvent& event_;
  const CriticalSensitivity& point_;
  const MatrixXd& here_;
  const Variation& variation_;
  const std::function<ModeOffsets(const ResolvedModel&)>& offsets_;
  double way_ = 0.0;     ///< 0: both senses; 1, -1: the value may only grow, or only fall
  Sides coarse_, fine_;  ///< equations with the best step and with half of it
};

/// Equations with another value at the point's state; empty when the model may not have that value.
std::optional<MatrixXd> VariationRate::equations_at(double value) const {
  const std::optional<Model> given = variation_.model_at(value);
  if (!given) return std::nullopt;
  ResolvedModel changed = resolve(*given);
  ModeOffsets modes;
  try {
    modes = offsets_(changed);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  const Structure structure = with_changed_model(structure_, std::move(changed), modes);
  if (structure.size != structure_.size) return std::nullopt;
  StructuralProblem problem(structure);
  problem.set_context(event_.point.context);
  return point_.equations(problem);
}

std::optional<VariationRate::Sides> VariationRate::sides(double step) {
  const double value = variation_.value;
  if (way_ == 0.0) {
    auto more = equations_at(value + step);
    auto less = equations_at(value - step);
    if (more && less) return Sides{*std::move(less), *std::move(more), step};
    if (!more && !less) return std::nullopt;
    way_ = more ? 1.0 : -1.0;
  }
  auto near = equations_at(value + 0.5 * way_ * step);
  auto far = equations_at(value + way_ * step);
  if (!near || !far) return std::nullopt;
  return Sides{*std::move(near), *std::move(far), step};
}

/// Rate by a difference of second order.
Rate VariationRate::difference(const Sides& at) const {
  if (way_ == 0.0) return point_.rate((at.more - at.less) / (2.0 * at.step));
  return point_.rate((4.0 * at.less - at.more - 3.0 * here_) / (way_ * at.step));
}

std::optional<Rate> VariationRate::best_difference(double lambda) {
  const double size = variation_.size;
  std::optional<Rate> best;
  double least = std::numeric_limits<double>::infinity();
  double step = DifferenceLimits::first_step * size;
  for (int n = 0; n < DifferenceLimits::steps; ++n, step *= DifferenceLimits::shorter) {
    auto coarse = sides(step);
    auto fine = coarse ? sides(0.5 * step) : std::nullopt;
    if (!fine) break;
    const double first = difference(*coarse).lambda;
    Rate rate = difference(*fine);
    const double error = std::abs(rate.lambda - first) + DifferenceLimits::rounding * std::abs(lambda) / step;
    if (!(error < least)) continue;
    least = error;
    rate.lambda = (4.0 * rate.lambda - first) / 3.0;
    best = rate;
    coarse_ = *std::move(coarse);
    fine_ = *std::move(fine);
    if (error <= DifferenceLimits::agreement * std::abs(rate.lambda) ||
        error * size <= DifferenceLimits::no_change * std::abs(lambda))
      break;
  }
  const bool settled = best && (least <= DifferenceLimits::rate_error * std::abs(best->lambda) ||
                                least * size <= DifferenceLimits::load_error * std::abs(lambda));
  return settled ? best : std::nullopt;
}

/// Difference between the one-sided rates.
double VariationRate::mismatch(const Sides& at) const {
  return point_.rate((at.more - 2.0 * here_ + at.less) / at.step).lambda;
}

/// Whether the one-sided rates differ, also over half the step: contact changes at the value.
bool VariationRate::has_kink(double lambda) const {
  if (!structure_.traits.one_sided || way_ != 0.0) return false;
  const double near = std::abs(mismatch(fine_));
  return near * variation_.size > DifferenceLimits::kink * std::abs(lambda) &&
         near > DifferenceLimits::smooth_fall * std::abs(mismatch(coarse_));
}

Sensitivity VariationRate::find(double lambda) {
  Sensitivity out{variation_.pointer, std::nullopt, std::nullopt};
  const auto rate = best_difference(lambda);
  if (rate && event_.type == CriticalType::bifurcation &&
      rate->breaking_share > DifferenceLimits::breaking_share &&
      rate->breaking * variation_.size > DifferenceLimits::imperfection) {
    out.reason = NoDerivative::breaks_bifurcation;
  } else if (!rate || has_kink(lambda)) {
    out.reason = NoDerivative::not_differentiable;
  } else {
    out.derivative = rate->lambda / structure_.scales.load;
  }
  return out;
}

std::optional<NoDerivative> refusal(const Structure& structure, const CriticalEvent& event) {
  if (event.cause == CriticalCause::contact) return NoDerivative::contact;
  if (event.multiplicity > 1) return NoDerivative::multiple;
  if (!structure.traits.symmetric) return NoDerivative::unsymmetric;
  return std::nullopt;
}

std::vector<Sensitivity> none(const std::vector<Variation>& variations, NoDerivative reason) {
  std::vector<Sensitivity> out;
  out.reserve(variations.size());
  for (const Variation& variation : variations) out.push_back({variation.pointer, std::nullopt, reason});
  return out;
}

}  // namespace

std::vector<Sensitivity> load_sensitivities(const std::vector<Variation>& variations,
                                            const Structure& structure, const LocatedPoint& at,
                                            const std::function<ModeOffsets(const ResolvedModel&)>& offsets,
                                            int& factorisations) {
  if (const auto reason = refusal(structure, at.event)) return none(variations, *reason);
  StructuralProblem problem(structure);
  problem.set_context(at.event.point.context);
  const PathMetric metric{&structure.metric, at.load_weight};
  const auto point = exact_point(problem, metric, at, factorisations);
  if (!point) return none(variations, NoDerivative::not_found);
  const bool limit = is_limit(at.event.type);
  const BorderedPoint bordered(problem, metric, point->solution, !limit);
  if (!limit) ++factorisations;
  if (!bordered.is_ready()) return none(variations, NoDerivative::not_found);
  const CriticalSensitivity sensitivity(bordered, point->target, limit);
  const MatrixXd here = sensitivity.equations(problem);
  std::vector<Sensitivity> out;
  out.reserve(variations.size());
  for (const Variation& variation : variations)
    out.push_back(VariationRate(structure, at.event, sensitivity, here, variation, offsets)
                      .find(point->solution.lambda));
  return out;
}

}  // namespace snapthrough
