#pragma once
/// @file
/// Global balance of a state, from what the result document gives alone.
///
/// A state holds positions and section forces. On the elements of a known fixed mesh displacements are
/// polynomials of the elements' order, so sampled at (order + 1) places or more of every element they can be
/// rebuilt exactly, and with them base reactions and the moments of loads. Then, for each member as a free
/// body,
///
///   F(L) - F(0) + int f ds = 0,     M(L) - M(0) + x(L) x F(L) - x(0) x F(0) + int x x f ds + sum of moments
///   = 0
///
/// (F the force through a section, from N, Q and the deformed angle), and for each node
///
///   sum over ends + point loads + springs = 0 in every direction that no support holds.

#include <array>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough::testing {

/// What is left over, of the largest force (or moment) that enters the sums.
struct Imbalance {
  double member_force = 0.0;
  double member_moment = 0.0;
  double node_force = 0.0;
  double node_moment = 0.0;
  double reactions[3] = {0.0, 0.0,
                         0.0};  ///< sum of all support reactions: force x, y, moment about the origin
  /// Of the reactions and resultants that the state gives, to those rebuilt from positions and section
  /// forces.
  double supports = 0.0;
  double springs = 0.0;
  double foundations = 0.0;
  double loads = 0.0;
  double sum = 0.0;  ///< of everything that the state says acts on the structure
};

/// @pre members are free of imperfections; a fixed mesh with equal elements on each member; the state has
/// output_points() points or (elements * m * order + 1) with integer m
[[nodiscard]] Imbalance imbalance_of(const Model& model, const Discretization& mesh, const State& state,
                                     Geometry geometry = Geometry::nonlinear);

/// points_per_member that imbalance_of() can use on this mesh, at most 401.
[[nodiscard]] int output_points(const Discretization& mesh);

/// Expects every part of the imbalance below the tolerance.
void expect_balance(const Model& model, const Discretization& mesh, const State& state, double tolerance,
                    Geometry geometry = Geometry::nonlinear);

}  // namespace snapthrough::testing
