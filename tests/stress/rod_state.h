#pragma once
/// @file
/// One state of a rod structure, rebuilt from samples, and what its equations leave over.

#include <array>
#include <string>
#include <vector>

#include "solver/result.h"
#include "tests/stress/rod_model.h"

namespace snapthrough::testing {

/// A support, or a point of a foundation's quadrature, that acts in a state.
struct ActingSupport {
  Functional row;
  double force = 0.0;
  double stiffness = 0.0;  ///< derivative of the force by the displacement
  bool is_stop = false;    ///< its force is the reported one, without the rounding of its displacement
};

/// An element's displacement and section forces in a state.
struct ElementState {
  MatrixXd u;               ///< (P + 1) x 3: u_a and u'_q, columns x, y, rotation
  VectorXd gradient_noise;  ///< of u'_q (x or y) from the samples' rounding
  VectorXd turn_noise;      ///< of b'_q
  VectorXd cos, sin, E, G;  ///< of the section; x' along and across it
  VectorXd N, Q, M;         ///< from equilibrium with the force through the end
  VectorXd bending;         ///< compliances against bending at these moments
  double force_noise = 0.0, moment_noise = 0.0;
  std::vector<ActingSupport> acting;
};

struct RodState {
  std::vector<ElementState> elements;
  std::vector<Eigen::Vector3d> start_force, end_force;  ///< of members, (force x, y, moment) through the ends
  std::vector<Eigen::Vector3d> nodes;  ///< displacements; a rotation that nothing shows is zero
  std::vector<double> node_stiffness;  ///< of the springs at nodes; 0: one that does not act
  std::vector<std::array<double, 2>> joint_stiffness;  ///< of the joints at members' starts and ends
  double residual = 0.0;                               ///< worst equation over its tolerance
  double roughness = 0.0;  ///< worst distance of a sample from its element's polynomial, over its tolerance
  std::string worst;
  /// Over 1: the shape is in equilibrium, but not with the section forces reported at the members' ends.
  double reported_force = 0.0;
};

/// @brief Evaluates a state; `state` has rod.points samples a member.
/// @param closer brings one-sided supports closer, by this many roundings of the displacement there: what
/// changes with it is not decided by the state's digits
/// @param imperfection slope that the state is in equilibrium without, as one at a bifurcation is that
/// rounding or the mesh breaks (`critical_points[].imperfection`): section forces turn by so much
[[nodiscard]] RodState evaluate(const RodModel& rod, const State& state, double closer = 0.0,
                                double imperfection = 0.0);

/// Factor of the proportional and of the constant actions.
[[nodiscard]] inline double factor(int pattern, double load_factor) {
  return pattern == 0 ? load_factor : 1.0;
}

}  // namespace snapthrough::testing
