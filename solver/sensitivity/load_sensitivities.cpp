#include "solver/sensitivity/load_sensitivities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "solver/events/critical_sensitivity.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {
namespace {

using Eigen::MatrixXd;
using Rate = CriticalSensitivity::Rate;

/// Derivative of the equations with respect to one variation, and the resulting sensitivity.
class VariationRate {
 public:
  /// @param here equations of the unchanged structure
  VariationRate(const Model& model, const Structure& structure, const CriticalEvent& event,
                const CriticalSensitivity& point, const MatrixXd& here, const Variation& variation,
                const std::function<ModeOffsets(const Model&)>& offsets)
      : model_(model),
        structure_(structure),
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

  const Model& model_;
  const Structure& structure_;
  const CriticalEvent& event_;
  const CriticalSensitivity& point_;
  const MatrixXd& here_;
  const Variation& variation_;
  const std::function<ModeOffsets(const Model&)>& offsets_;
  double way_ = 0.0;     ///< 0: both senses; 1, -1: the value may only grow, or only fall
  Sides coarse_, fine_;  ///< equations with the best step and with half of it
};

/// Equations with another value at the point's state; empty when the model may not have that value.
std::optional<MatrixXd> VariationRate::equations_at(double value) const {
  const std::optional<Model> changed = variation_.model_at(value);
  if (!changed) return std::nullopt;
  ModeOffsets modes;
  try {
    modes = offsets_(*changed);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  const Structure structure = with_changed_model(structure_, model_, *changed, modes);
  if (structure.size != structure_.size) return std::nullopt;
  StructuralProblem problem(structure);
  problem.set_holds(event_.point.holds);
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
  constexpr double kFirst = 2.5e-4;   // first step over the variation's size
  constexpr double kShorter = 0.125;  // ratio of successive steps
  constexpr int kMostSteps = 6;
  constexpr double kAgree = 1e-6;  // relative agreement; the error after extrapolation is about its square
  // change of the load, per change by the variation's size, that counts as zero
  constexpr double kNothing = 1e-8;
  constexpr double kRounding = 1e-13;  // rounding of a difference over the load
  constexpr double kDiffer = 1e-3;     // largest accepted error over the rate
  // largest accepted error over the load, per change by the variation's size
  constexpr double kCounts = 1e-6;
  const double size = variation_.size;
  std::optional<Rate> best;
  double least = std::numeric_limits<double>::infinity();
  double step = kFirst * size;
  for (int n = 0; n < kMostSteps; ++n, step *= kShorter) {
    auto coarse = sides(step);
    auto fine = coarse ? sides(0.5 * step) : std::nullopt;
    if (!fine) break;
    const double first = difference(*coarse).lambda;
    Rate rate = difference(*fine);
    const double error = std::abs(rate.lambda - first) + kRounding * std::abs(lambda) / step;
    if (!(error < least)) continue;
    least = error;
    rate.lambda = (4.0 * rate.lambda - first) / 3.0;
    best = rate;
    coarse_ = *std::move(coarse);
    fine_ = *std::move(fine);
    if (error <= kAgree * std::abs(rate.lambda) || error * size <= kNothing * std::abs(lambda)) break;
  }
  const bool settled =
      best && (least <= kDiffer * std::abs(best->lambda) || least * size <= kCounts * std::abs(lambda));
  return settled ? best : std::nullopt;
}

/// Difference between the one-sided rates.
double VariationRate::mismatch(const Sides& at) const {
  return point_.rate((at.more - 2.0 * here_ + at.less) / at.step).lambda;
}

/// Whether the one-sided rates differ, also over half the step: contact changes at the value.
bool VariationRate::has_kink(double lambda) const {
  // decrease of the difference of rates, when the step is halved, without a kink
  constexpr double kFalls = 0.75;
  constexpr double kCounts = 1e-5;  // relative change of the load by the kink that is ignored
  if (!structure_.one_sided || way_ != 0.0) return false;
  const double near = std::abs(mismatch(fine_));
  return near * variation_.size > kCounts * std::abs(lambda) && near > kFalls * std::abs(mismatch(coarse_));
}

Sensitivity VariationRate::find(double lambda) {
  // work of forces on the mode relative to its terms, caused by rounding and mesh
  constexpr double kShare = 1e-5;
  // imperfection, per change by the variation's size, that counts as zero
  constexpr double kImperfection = 1e-9;
  Sensitivity out{variation_.pointer, std::nullopt, std::nullopt};
  const auto rate = best_difference(lambda);
  if (rate && event_.type == CriticalType::bifurcation && rate->breaking_share > kShare &&
      rate->breaking * variation_.size > kImperfection) {
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
  if (!structure.follower_ends.empty()) return NoDerivative::unsymmetric;
  return std::nullopt;
}

std::vector<Sensitivity> none(const std::vector<Variation>& variations, NoDerivative reason) {
  std::vector<Sensitivity> out;
  out.reserve(variations.size());
  for (const Variation& variation : variations) out.push_back({variation.pointer, std::nullopt, reason});
  return out;
}

}  // namespace

std::vector<Sensitivity> load_sensitivities(const Model& model, const std::vector<Variation>& variations,
                                            const Structure& structure, const LocatedPoint& at,
                                            const std::function<ModeOffsets(const Model&)>& offsets,
                                            int& factorisations) {
  if (const auto reason = refusal(structure, at.event)) return none(variations, *reason);
  StructuralProblem problem(structure);
  problem.set_holds(at.event.point.holds);
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
    out.push_back(VariationRate(model, structure, at.event, sensitivity, here, variation, offsets)
                      .find(point->solution.lambda));
  return out;
}

}  // namespace snapthrough
