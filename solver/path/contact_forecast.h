#pragma once
/// @file
/// Where foundations of one side will act at the end of a step.

#include <Eigen/Core>
#include <vector>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief Where one-sided foundations will act at the end of a step.
///
/// A predicted displacement does not tell: next to the end of a zone of contact the gap is that of a boundary
/// layer of length (4 EI / K)^(1/4), which moves along the member as the zone grows or shrinks. Its ends move
/// smoothly, however stiff the foundation is; so they are extrapolated, by their rates at the start of the
/// step and by where they were at the start of the step before.
class ContactForecast {
 public:
  /// @brief A step begins at y with this tangent.
  void begin(const EquilibriumProblem& problem, const Eigen::VectorXd& y, const Eigen::VectorXd& tangent);
  /// @brief The step that was begun last ended where the next begins, at this distance.
  void follow(double chord);
  /// @brief The next step has none before it.
  void forget();
  /// @brief From now on distances are this much larger.
  void scale(double factor) { chord_ *= factor; }
  /// @brief Where supports act at the end of a step of this length; valid until the next call.
  /// @param predicted displacements there by the path's tangent
  /// @return null when the problem has no foundation of one side
  [[nodiscard]] const FrozenContact* at(const EquilibriumProblem& problem, double step,
                                        const Eigen::VectorXd& predicted);
  /// @brief Whether the last forecast has other zones than the step begins with: one begins, ends, or two
  /// meet.
  [[nodiscard]] bool changes() const { return changes_; }
  /// @brief Elements on which foundations act at y against the last forecast, or do not though it said so.
  [[nodiscard]] double missed(const EquilibriumProblem& problem, const Eigen::VectorXd& y) const;

 private:
  [[nodiscard]] MovingZones extrapolated(double step) const;

  MovingZones now_;     ///< at the start of the step
  MovingZones last_;    ///< at the start of the one before; empty: there is none
  double chord_ = 0.0;  ///< distance between them
  FrozenContact ahead_;
  bool changes_ = false;  ///< ahead_ has other zones than now_
};

}  // namespace snapthrough
