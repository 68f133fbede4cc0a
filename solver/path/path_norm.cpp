#include "solver/path/path_norm.h"

#include <algorithm>
#include <cmath>

namespace snapthrough {
namespace {

/// Load bound over the load scale of the member that buckles first, and of the member that buckles last.
/// Source: no critical point of interest was met beyond, see docs/stress.md.
struct LoadBoundFactors {
  static constexpr double above_weakest = 1e4;
  static constexpr double above_strongest = 30.0;
};

}  // namespace

double PathNorm::distance(const PathPoint& a, const PathPoint& b) const {
  return metric_.norm(b.y - a.y, b.lambda - a.lambda);
}

double PathNorm::angle(const PathPoint& a, const PathPoint& b) const {
  return std::acos(
      std::clamp(metric_.inner(a.tangent, a.tangent_lambda, b.tangent, b.tangent_lambda), -1.0, 1.0));
}

double PathNorm::arc(const PathPoint& a, const PathPoint& b) const {
  return PathMetric{metric_.weights, arc_load_weight_}.norm(b.y - a.y, b.lambda - a.lambda);
}

double PathNorm::arc_per_step(const PathPoint& point) const {
  return PathMetric{metric_.weights, arc_load_weight_}.norm(point.tangent, point.tangent_lambda);
}

double PathNorm::search_scale(const PathPoint& point) const {
  return std::min({point.arc_length, metric_.norm(point.y, point.lambda), Gradients::large});
}

void PathNorm::set_scales(const EquilibriumProblem& problem, const Eigen::VectorXd& response) {
  const double norm = metric_.norm(response, 0.0);
  load_scale_ = problem.critical_load_scale(response);
  if (norm > 0.0) load_scale_ = std::min(load_scale_, Gradients::large / norm);
  if (!std::isfinite(load_scale_)) load_scale_ = 1.0;
  load_bound_ = std::max(LoadBoundFactors::above_weakest * load_scale_,
                         LoadBoundFactors::above_strongest * problem.largest_critical_load_scale(response));
  const double gradient = std::clamp(norm * load_scale_, Gradients::small, Gradients::large) / load_scale_;
  metric_.load_weight = gradient * gradient;
  arc_load_weight_ = metric_.load_weight;
}

void PathNorm::adopt(const PathNorm& other) {
  load_scale_ = other.load_scale_;
  load_bound_ = other.load_bound_;
  metric_.load_weight = other.metric_.load_weight;
  arc_load_weight_ = other.arc_load_weight_;
}

}  // namespace snapthrough
