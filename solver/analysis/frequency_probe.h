#pragma once
/// @file
/// Natural frequencies of the states that an analysis reaches.

#include <Eigen/Core>
#include <optional>

#include "solver/discrete/mass_matrix.h"
#include "solver/events/natural_motions.h"
#include "solver/problem/structural_problem.h"
#include "solver/result.h"

namespace snapthrough {

/// Eigenvalues in the model's units. @param unit omega^2 of the scaled eigenvalue one
[[nodiscard]] Frequencies in_units(const NaturalMotions& motions, const Structure& structure, double unit);

/// Finds the lowest natural motions of one state after another; each search begins with the motions before.
class FrequencyProbe {
 public:
  /// @param structure kept by reference; must outlive this object
  /// @param analysis of type vibration: what its rows lack is told with them; of another type: how many
  /// frequencies its rows have, to a thousandth of its accuracy
  /// @pre structure.traits.has_mass
  FrequencyProbe(const Structure& structure, const Analysis& analysis);

  /// @param y, lambda scaled unknowns and load factor of an equilibrium
  /// @return empty: one-sided supports touch without pressure, so that small vibrations are not linear; or,
  /// of an analysis of another type than vibration, the search did not converge or an inertia count found
  /// lower motions that it missed
  [[nodiscard]] std::optional<NaturalMotions> at(const Eigen::VectorXd& y, double lambda);
  /// Eigenvalues in the model's units.
  [[nodiscard]] Frequencies in_units(const NaturalMotions& motions) const {
    return snapthrough::in_units(motions, structure_, unit());
  }
  /// omega^2 of the scaled eigenvalue one, in the model's units.
  [[nodiscard]] double unit() const { return masses_.square; }
  [[nodiscard]] double scale() const { return masses_.scale; }

 private:
  const Structure& structure_;
  StructuralProblem problem_;
  MassMatrix masses_;
  MotionSearch search_;
  bool is_asked_alone_ = false;  ///< the analysis is of type vibration
  KrylovColumns columns_;
};

}  // namespace snapthrough
