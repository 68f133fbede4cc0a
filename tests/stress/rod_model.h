#pragma once
/// @file
/// The checker's own discrete rod structure. Lengths are over the longest member's, forces over the largest
/// EI / length^2.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "solver/geometry/stress_free_axis.h"
#include "solver/mesh/mesh.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"
#include "tests/stress/rod_cable.h"
#include "tests/stress/rod_law.h"
#include "tests/stress/rod_rule.h"
#include "tests/stress/rod_surface.h"

namespace snapthrough::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Linear functional of an element's displacements, a.u_a + sum_q v(:, q).u'_q.
struct Functional {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  MatrixXd v;  ///< 3 x P
};

/// Rigid stop, whose force is that which a state reports.
struct RodStop {
  std::size_t spring = 0;  ///< of the model
  double sense = 1.0;      ///< of the reported force
};

/// Law of a discrete support or joint: the force is share * law(unit * penetration).
struct RodReaction {
  RodLaw law;
  double unit = 1.0;   ///< model's units of one of the checker's
  double share = 1.0;  ///< checker's force of the law's force one
  double gap = 0.0;
  bool one_sided = false;
  std::optional<RodStop> stop = {};
  double without_force = 0.0;  ///< displacement at which a pretension leaves no force

  /// @param w displacement into the medium
  [[nodiscard]] bool acts(double w) const { return !one_sided || w > without_force + gap; }
  [[nodiscard]] double force(double w) const { return share * law.force(penetration(w)); }
  [[nodiscard]] double slope(double w) const { return share * unit * law.slope(penetration(w)); }
  /// Displacement beyond the gap and beyond that of a pretension, in the model's units: the argument of
  /// `law`.
  [[nodiscard]] double penetration(double w) const { return unit * (w - without_force - gap); }
};

struct RodSpring {
  Functional row;
  RodReaction reaction;
};

/// Place of an element on a foundation.
struct RodSite {
  double xi = 0.0;
  VectorXd weights;                                     ///< of u'_q in the displacement
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< into the medium, unless a surface gives it
  double gap = 0.0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< of the perfect axis
};

/// Foundation on the part [lo, hi] of an element that is one-sided or not linear.
struct RodStrip {
  LawAlong law;
  double gap = 0.0, lo = 0.0, hi = 1.0;
  std::vector<std::pair<double, double>> gap_along;
  bool one_sided = false;
  int sign = 1;  ///< of the left normal, towards which it reacts
  FoundationComponent component = FoundationComponent::normal;
  double unit = 1.0;   ///< model's units of one of the depth's: of a length, or of an angle
  double share = 1.0;  ///< checker's force or moment by one of the law over one of the checker's length
  std::optional<std::array<double, 2>> fixed;  ///< instead of both
  std::shared_ptr<const RodSurface> surface;   ///< instead of all of them, and of the gap
  bool takes_planes = false;   ///< of the surface it takes the planes that touch it beside the initial axis
  std::vector<RodSite> sites;  ///< at which the depth is sampled, ascending

  [[nodiscard]] bool follows_surface() const { return surface && !takes_planes; }
};

/// Displacement into a medium beyond the gap, or depth below its surface, with its derivatives.
struct StripDepth {
  double value = 0.0;
  Functional row;     ///< first derivative
  Functional across;  ///< of the displacement along the surface
  double bend = 0.0;  ///< second derivative by that displacement
};

/// Follower pressure of an element, linear from its start to its end.
struct RodPressure {
  double from = 0.0, to = 0.0;
  [[nodiscard]] double at(double xi) const { return from + xi * (to - from); }
};

struct RodElement {
  int member = 0;
  double from = 0.0, to = 1.0, h = 0.0;
  VectorXd angle, tx, ty, e0, g0, stretch;  ///< at the Gauss points
  VectorXd axial, shear, bending;           ///< compliances there; 0: rigid; of a bending law without moment
  bool shears = false;                      ///< whether the section can shear
  double softest = 0.0;  ///< bending compliance without moment at the end of less stiffness
  std::shared_ptr<const BendingCurvature> law;  ///< of bending; null: the curvature is `bending` times M
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

/// Spring at a node; its displacement is row . (u of `node` - u of `to`).
struct NodeSpring {
  int node = 0;
  int to = -1;  ///< node at its other end; -1: the ground
  Eigen::Vector3d row = Eigen::Vector3d::Zero();
  double sense = 1.0;  ///< of the model's direction along the row
  RodReaction reaction;
  std::size_t place = 0;  ///< in the model's list
};

/// Rod between two nodes, which takes a compression or a tension only, or a cable.
struct RodBar {
  int start = 0, end = 0;
  Eigen::Vector2d along = Eigen::Vector2d::Zero();  ///< from its start to its end, unloaded
  double stiffness = 0.0;                           ///< force of a lengthening of one
  double stretched = 0.0;               ///< length between its nodes, unloaded, less its length without force
  int sign = 1;                         ///< of the force that it takes; 1 is a tension
  std::size_t member = 0;               ///< of the model
  std::array<double, 2> lengthening{};  ///< by temperature, without force: proportional, constant
  std::optional<HangingBar> cable = {};

  /// @param now vector from its start to its end
  [[nodiscard]] BarPull pull(const Eigen::Vector2d& now, double load_factor) const;
};

/// Joint of a member's end and its node.
struct RodJoint {
  bool turns = false;    ///< the end has a rotation of its own
  bool resists = false;  ///< the joint is no hinge
  RodReaction reaction;  ///< moment by the rotation of the end relative to the node
};

struct RodMember {
  int start = 0, end = 0;
  std::size_t place = 0;  ///< in the model's list, which has rods too
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
  std::vector<RodBar> bars;
  std::vector<RodMember> members;
  std::vector<RodElement> elements;
};

/// @brief The discrete structure of a request without mode imperfections, geometry nonlinear, on the mesh of
/// its path.
/// @param told where the elements of a path after the first end; those of the first are the request's
[[nodiscard]] RodModel make_rod_model(const Model& model, const Analysis& analysis, const MeshReport& told);

/// Largest EI of the sections that are not rigid.
[[nodiscard]] double largest_bending(const Model& model);

/// @brief Functional of the displacement at xi, times the components of `row`.
[[nodiscard]] Functional functional_at(const RodModel& rod, const RodElement& element, double xi,
                                       const Eigen::Vector3d& row);

/// @brief The law of a base on an element, in the model's units: a one-sided one with a stiffness decays over
/// no shorter length than its mesh resolves, a rigid one than the longest element of its member does.
[[nodiscard]] LawAlong acting_law(const RodModel& rod, const RodElement& element, const Foundation& base);

/// Fraction of the member's length at xi of its element.
[[nodiscard]] inline double fraction_at(const RodElement& element, double xi) {
  return element.from + xi * (element.to - element.from);
}

/// @brief Direction and gap of a base, as a strip on a whole element without a law.
[[nodiscard]] RodStrip strip_of(const RodModel& rod, const Foundation& base);

/// Place of a strip at xi of the element.
[[nodiscard]] RodSite site_of(const RodModel& rod, const RodElement& element, const RodStrip& strip,
                              double xi);

/// @brief Depth in a state. @param u displacements (P + 1) x 3 of the element: u_a and u'_q
[[nodiscard]] double depth_at(const RodStrip& strip, const RodSite& site, const MatrixXd& u);
[[nodiscard]] StripDepth depth_with_derivatives(const RodStrip& strip, const RodSite& site,
                                                const MatrixXd& u);

/// @brief The model without its one-sided members, which have no elements.
[[nodiscard]] Model without_bars(Model model);

}  // namespace snapthrough::testing
