#pragma once
/// @file
/// Predicts the end of a step: its place and where one-sided supports will act there.

#include <Eigen/Core>

#include "solver/path/contact_forecast.h"
#include "solver/path/path_norm.h"
#include "solver/path/path_point.h"

namespace snapthrough {

/// @brief Predicts along the tangent and, once a step is remembered, along the cubic through both of its ends
/// and tangents. A new predictor goes by the tangent and forecasts no contact.
class Predictor {
 public:
  /// @brief Remembers the accepted step before -> from.
  /// @param with_curvature whether the next step may follow the cubic; where contact changes the cubic is
  /// worse than the tangent
  void remember(const PathNorm& norm, const PathPoint& before, const PathPoint& from, bool with_curvature);
  /// Forgets all steps: the next one is predicted by its tangent and contact by its rates.
  void reset();
  /// Forgets the curvature, which is good for one attempt.
  void forget_curvature() { curvature_ = {}; }
  /// From now on the path's norm makes distances this much larger.
  void rescale(double factor);

  /// @brief Begins the forecast of contact for a step from a point.
  void begin_forecast(const EquilibriumProblem& problem, const PathPoint& from);
  /// Sets y and lambda of `to`, a step of this size from `from`.
  void predict(const PathPoint& from, double step, PathPoint& to) const;
  /// @brief Where supports act at the end of a step; null where no foundation is one-sided.
  /// @pre begin_forecast() for this step
  [[nodiscard]] const FrozenContact* forecast(const EquilibriumProblem& problem, double step,
                                              const PathPoint& predicted) {
    return forecast_.at(problem, step, predicted.y);
  }
  /// The last forecast, to compare it with what was met.
  [[nodiscard]] const ContactForecast& last_forecast() const { return forecast_; }

 private:
  /// Second and third derivative of the path by its length; empty: not known.
  struct Curvature {
    Eigen::VectorXd y2, y3;
    double lambda2 = 0.0, lambda3 = 0.0;
  };
  Curvature curvature_;
  ContactForecast forecast_;
};

}  // namespace snapthrough
