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

/// Finds the lowest natural motions of one state after another; each search begins with the motions before.
class FrequencyProbe {
 public:
  /// @param structure kept by reference; must outlive this object
  /// @param count number of frequencies
  /// @param counted whether inertia counts confirm each state, as in MotionSearch
  /// @pre has_mass(model)
  FrequencyProbe(const Structure& structure, const Model& model, int count, bool counted);

  /// @param y, lambda scaled unknowns and load factor of an equilibrium
  /// @return empty: one-sided supports touch without pressure, so that small vibrations are not linear
  [[nodiscard]] std::optional<NaturalMotions> at(const Eigen::VectorXd& y, double lambda);
  /// Eigenvalues in the model's units.
  [[nodiscard]] Frequencies in_units(const NaturalMotions& motions) const;
  /// omega^2 of the scaled eigenvalue one, in the model's units.
  [[nodiscard]] double unit() const { return masses_.square; }
  [[nodiscard]] double scale() const { return masses_.scale; }

 private:
  const Structure& structure_;
  StructuralProblem problem_;
  MassMatrix masses_;
  MotionSearch search_;
};

}  // namespace snapthrough
