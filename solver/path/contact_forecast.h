#pragma once
/// @file
/// Forecast of the zones on which one-sided foundations act at the end of a step.

#include <Eigen/Core>
#include <vector>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief Forecasts the zones on which one-sided foundations act at the end of a step.
///
/// A predicted displacement does not give the zones: next to the end of a zone the gap is that of a boundary
/// layer of length (4 EI / K)^(1/4), which moves along the member as the zone grows or shrinks. The ends of
/// zones move smoothly, however stiff the foundation is. The forecast extrapolates each end by its rate at
/// the start of the step and by its place at the start of the step before.
class ContactForecast {
 public:
  /// @brief Begins a step at y with a tangent.
  void begin(const EquilibriumProblem& problem, const Eigen::VectorXd& y, const Eigen::VectorXd& tangent);
  /// @brief Ends the step that was begun last, at this distance from its start; the next one begins there.
  void follow(double chord);
  /// @brief Forgets the step before: the next forecast goes by rates alone.
  void forget();
  /// @brief Scales distances to a new norm of the path, in which they are `factor` times as large.
  void scale(double factor) { chord_ *= factor; }
  /// @brief Forecasts where supports act at the end of a step of this length; valid until the next call.
  /// @param predicted displacements at the end of the step; zones that begin are taken from them
  /// @return null when the problem has no foundation of one side
  [[nodiscard]] const FrozenContact* at(const EquilibriumProblem& problem, double step,
                                        const Eigen::VectorXd& predicted);
  /// @brief Whether a zone begins or ends within the last forecast, or two zones meet.
  [[nodiscard]] bool changes() const { return changes_; }
  /// @brief Length, in elements, on which contact at y differs from the last forecast.
  [[nodiscard]] double missed(const EquilibriumProblem& problem, const Eigen::VectorXd& y) const;

 private:
  [[nodiscard]] MovingZones extrapolated(double step) const;

  MovingZones now_;     ///< zones at the start of the step
  MovingZones last_;    ///< zones at the start of the step before; empty: there is none
  double chord_ = 0.0;  ///< distance of the two starts in the path's norm
  FrozenContact ahead_;
  bool changes_ = false;  ///< ahead_ has other zones than now_
};

}  // namespace snapthrough
