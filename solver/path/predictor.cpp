#include "solver/path/predictor.h"

#include <cmath>

#include "solver/numeric/cubic.h"

namespace snapthrough {

void Predictor::remember(const PathNorm& norm, const PathPoint& before, const PathPoint& from,
                         bool with_curvature) {
  curvature_ = {};
  const double chord = norm.distance(before, from);
  forecast_.follow(chord);
  if (!with_curvature || !(chord > 0.0)) return;
  const double half = 0.5 * norm.angle(before, from);
  const double d = half > 0.0 ? chord * half / std::sin(half) : chord;
  const double rise_lambda = from.lambda - before.lambda;
  curvature_.y2 = second_derivative_at_end(from.y - before.y, before.tangent, from.tangent, d);
  curvature_.y3 = third_derivative(from.y - before.y, before.tangent, from.tangent, d);
  curvature_.lambda2 = second_derivative_at_end(rise_lambda, before.tangent_lambda, from.tangent_lambda, d);
  curvature_.lambda3 = third_derivative(rise_lambda, before.tangent_lambda, from.tangent_lambda, d);
}

void Predictor::reset() {
  curvature_ = {};
  forecast_.forget();
}

void Predictor::rescale(double factor) {
  forecast_.scale(factor);
  curvature_ = {};
}

void Predictor::begin_forecast(const EquilibriumProblem& problem, const PathPoint& from) {
  if (from.arc_length > 0.0) return forecast_.begin(problem, from.y, from.tangent);
  // where everything touches from nothing, contact is that of the first small load
  forecast_.begin(problem, from.y + Gradients::tiny * from.tangent, from.tangent);
}

void Predictor::predict(const PathPoint& from, double step, PathPoint& to) const {
  to.y = from.y + step * from.tangent;
  to.lambda = from.lambda + step * from.tangent_lambda;
  if (curvature_.y2.size() == 0) return;
  to.y += (0.5 * step * step) * curvature_.y2 + (step * step * step / 6.0) * curvature_.y3;
  to.lambda += 0.5 * step * step * curvature_.lambda2 + step * step * step / 6.0 * curvature_.lambda3;
}

}  // namespace snapthrough
