#pragma once
/// @file
/// The checker's own discrete rod structure. Lengths are over the longest member's, forces over the largest
/// EI / length^2.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "solver/geometry/stress_free_axis.h"
#include "solver/mesh/mesh.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"
#include "tests/stress/rod_law.h"
#include "tests/stress/rod_rule.h"

namespace snapthrough::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Linear functional of an element's displacements, a.u_a + sum_q v(:, q).u'_q.
struct Functional {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  MatrixXd v;  ///< 3 x P
};

/// Law of a discrete support: the force is share * law(unit * penetration).
struct RodReaction {
  RodLaw law;
  double unit = 1.0;   ///< model's units of one of the checker's
  double share = 1.0;  ///< checker's force of the law's force one
  double gap = 0.0;
  bool one_sided = false;

  /// @param w displacement into the medium
  [[nodiscard]] bool acts(double w) const { return !one_sided || w > gap; }
  [[nodiscard]] double force(double w) const { return share * law.force(unit * (w - gap)); }
  [[nodiscard]] double slope(double w) const { return share * unit * law.slope(unit * (w - gap)); }
};

struct RodSpring {
  Functional row;
  RodReaction reaction;
};

/// Foundation on the part [lo, hi] of an element that is one-sided or not linear.
struct RodStrip {
  LawAlong law;
  double gap = 0.0, lo = 0.0, hi = 1.0;
  bool one_sided = false;
  int sign = 1;                                ///< of the left normal, towards which it reacts
  bool tangential = false;                     ///< along the tangent instead of the normal
  std::optional<std::array<double, 2>> fixed;  ///< instead of both
  std::vector<double> x;                       ///< places at which the displacement is sampled, ascending
  std::vector<Functional> rows;                ///< displacements into the medium there
};

/// Follower pressure of an element, linear from its start to its end.
struct RodPressure {
  double from = 0.0, to = 0.0;
  [[nodiscard]] double at(double xi) const { return from + xi * (to - from); }
};

struct RodElement {
  int member = 0;
  double from = 0.0, to = 1.0, h = 0.0;
  VectorXd angle, tx, ty, e0, g0, stretch;         ///< at the Gauss points
  double axial = 0.0, shear = 0.0, bending = 0.0;  ///< compliances
  std::vector<RodSpring> springs;
  std::vector<RodStrip> strips;
  std::array<Functional, 2> load;  ///< proportional, constant
  std::array<RodPressure, 2> pressure{};
  std::array<VectorXd, 2> strain, curvature;  ///< at the Gauss points
  std::vector<int> samples;                   ///< of the member's state
  MatrixXd fit;                               ///< (P + 1) x samples: u_a and u'_q
  MatrixXd basis;                             ///< samples x (P + 1)
};

struct RodNode {
  std::array<bool, 3> fixed{};
  double angle = 0.0;
  std::array<Eigen::Vector3d, 2> displacement{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<Eigen::Vector3d, 2> load{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

struct NodeSpring {
  int node = 0;
  Eigen::Vector3d row = Eigen::Vector3d::Zero();
  RodReaction reaction;
};

/// Joint of a member's end and its node.
struct RodJoint {
  bool turns = false;      ///< the end has a rotation of its own
  double stiffness = 0.0;  ///< moment of a relative rotation of one
};

struct RodMember {
  int start = 0, end = 0;
  RodJoint at_start, at_end;
  std::vector<StressFreePoint> sampled;  ///< stress-free axis at the samples, in the model's units
};

struct RodModel {
  double length = 1.0, force = 1.0;
  std::array<double, 2> origin{};
  double extent = 0.0;  ///< largest coordinate that the samples carry, over length
  int points = 0;
  /// Whether bases end in forces at single places (lumped springs, edges of shear layers): a section force
  /// reported there has two values, so the forces through members' ends are then found from the equations.
  bool concentrated = false;
  Lagrange lagrange{1};
  Axes axes;
  Mesh mesh;
  std::vector<RodNode> nodes;
  std::vector<NodeSpring> node_springs;
  std::vector<RodMember> members;
  std::vector<RodElement> elements;
};

/// @brief The discrete structure of a request without mode imperfections, geometry nonlinear, on the mesh of
/// its path.
/// @param told where the elements of a path after the first end; those of the first are the request's
[[nodiscard]] RodModel make_rod_model(const Model& model, const Analysis& analysis, const MeshReport& told);

/// @brief Functional of the displacement at xi, times the components of `row`.
[[nodiscard]] Functional functional_at(const RodModel& rod, const RodElement& element, double xi,
                                       const Eigen::Vector3d& row);

/// @brief The law of a base on an element, in the model's units: a one-sided one with a stiffness decays over
/// no shorter length than its mesh resolves.
[[nodiscard]] LawAlong acting_law(const RodModel& rod, const RodElement& element, const Foundation& base);

/// Fraction of the member's length at xi of its element.
[[nodiscard]] inline double fraction_at(const RodElement& element, double xi) {
  return element.from + xi * (element.to - element.from);
}

/// @brief Direction and gap of a base, as a strip on a whole element without a law.
[[nodiscard]] RodStrip strip_of(const RodModel& rod, const Foundation& base);

/// @brief Unit direction in which a base on this strip reacts, at xi of the element.
[[nodiscard]] Eigen::Vector3d direction_of(const RodModel& rod, const RodElement& element,
                                           const RodStrip& strip, double xi);

}  // namespace snapthrough::testing
