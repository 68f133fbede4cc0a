#pragma once
/// @file
/// Second variation of the rod's energy at a state, as a dense constrained matrix.

#include <Eigen/Core>

#include "tests/stress/rod_state.h"

namespace snapthrough::testing {

/// A symmetric matrix over displacements and as many multipliers as there are constraints: its negative
/// eigenvalues less `constraints` are those of the constrained tangent (Haynsworth).
struct ConstrainedTangent {
  MatrixXd matrix;
  int constraints = 0;
  /// Antisymmetric rest of the tangent, which follower pressure leaves where pressed lines end.
  MatrixXd rest;
};

/// Size of the matrix without building it.
[[nodiscard]] int tangent_size(const RodModel& rod);
[[nodiscard]] ConstrainedTangent tangent_of(const RodModel& rod, const RodState& at, double load_factor);

}  // namespace snapthrough::testing
