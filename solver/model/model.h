#pragma once
/// @file
/// The structure as its user describes it. Plain data in consistent units of the user's choice, one field for
/// each field of the request document. Values are not checked here: see solver/check/check.h.
///
/// Axes: x to the right, y up, rotation counter-clockwise. A member runs from `start` to `end` with tangent
/// t; its left normal n is t turned by +90 degrees. Fractions refer to the member's undeformed length.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/model/along_member.h"

namespace snapthrough {

/// Multiplier of a load or prescribed displacement.
enum class Pattern { proportional, constant };
/// Reaction type of an elastic support: both ways, push only, pull only.
enum class Reaction { bilateral, compression_only, tension_only };
/// Side of a member, viewed from its start to its end.
enum class Side { left, right };
/// Length to which a distributed load refers.
enum class LoadMeasure { length, horizontal, vertical };
/// Axes of a force: global x and y, or the initial tangent and left normal of its member.
enum class LoadAxes { global, member };
/// Displacement component; `normal` is along the initial left normal and needs a location on a member.
enum class Component { x, y, rotation, normal };

/// Distance of fractions of a member's length that counts as zero.
inline constexpr double kOnePlace = 1e-9;

/// Location on the structure: a node, or a point of a member. Exactly one of `node`, `member` is not empty.
struct Location {
  std::string node;
  std::string member;
  double fraction = 0.0;  ///< fraction of the undeformed length, in [0, 1]; used with `member`
  bool operator==(const Location&) const = default;
};

struct Node {
  std::string id;
  double x = 0.0;
  double y = 0.0;
  bool operator==(const Node&) const = default;
};

/// How a table is read between its points.
enum class Interpolation { monotone_cubic, linear };

/// @brief Curvature k of a section as a function of its bending moment M >= 0; k(-M) = -k(M). Unloading
/// follows the curve back.
struct BendingLaw {
  enum class Type {
    ramberg_osgood,  ///< k = (M + coefficient moment (M / moment)^exponent) / EI
    table            ///< k through `points`, with the last slope beyond the last point
  };
  Type type = Type::table;
  double moment = 0.0;       ///< > 0
  double coefficient = 1.0;  ///< >= 0
  double exponent = 2.0;     ///< in [2, kMaxBendingExponent]
  /// (k, M) from the origin on, which may be left out; both ascend. A cubic gives k by M.
  std::vector<std::array<double, 2>> points;
  Interpolation interpolation = Interpolation::monotone_cubic;
  bool operator==(const BendingLaw&) const = default;
};

/// @brief Elastic strength of a section: its outer fibres, which are as far from its axis on both sides,
/// reach the strength of the material in tension under `axial_force` alone, and under `bending_moment` alone.
struct Strength {
  AlongMember axial_force;     ///< strength times area, > 0
  AlongMember bending_moment;  ///< strength times section modulus, > 0
  double compression = 1.0;    ///< strength in compression over that in tension, > 0
  bool operator==(const Strength&) const = default;
};

/// Elastic section, which may taper: fractions of its numbers are those of each member that has the section.
/// No GA means unshearable (the limit GA -> infinity is taken exactly).
struct Section {
  std::string id;
  AlongMember EA;                        ///< axial stiffness, > 0
  AlongMember EI;                        ///< bending stiffness, > 0; with a law dM / dk without moment
  std::optional<AlongMember> GA;         ///< shear stiffness (shear area included), > 0
  std::optional<AlongMember> mass = {};  ///< mass per undeformed length, >= 0; needed by self weight
  /// Moment of inertia of the mass about the section's centre, per undeformed length; empty: zero.
  std::optional<AlongMember> rotary_inertia = {};
  std::optional<double> expansion = {};    ///< thermal strain per degree; needed by temperature loads
  std::optional<BendingLaw> bending = {};  ///< empty: the curvature is M / EI
  std::optional<Strength> strength = {};   ///< empty: stresses are not compared with a strength
  bool operator==(const Section&) const = default;
};

struct LineCurve {
  bool operator==(const LineCurve&) const = default;
};
/// Circular arc that turns by `sweep_degrees` from start to end, positive to the left; 0 < |sweep| < 360.
struct ArcCurve {
  double sweep_degrees = 0.0;
  bool operator==(const ArcCurve&) const = default;
};
/// Offset 4 rise xi (1 - xi) from the chord along `direction`, xi in [0, 1] along the chord. Every piece of a
/// parabola has this form with the direction of the parabola's axis.
struct ParabolaCurve {
  double rise = 0.0;
  std::optional<std::array<double, 2>> direction = {};  ///< empty: left normal of the chord
  bool operator==(const ParabolaCurve&) const = default;
};
/// Offset rise * sin(half_waves * pi * xi) along the chord's left normal, xi in [0, 1] along the chord.
struct SineCurve {
  double rise = 0.0;
  int half_waves = 1;
  bool operator==(const SineCurve&) const = default;
};
/// C2 cubic spline from the start through interior points to the end.
struct PointsCurve {
  std::vector<std::array<double, 2>> points;
  bool operator==(const PointsCurve&) const = default;
};
using Curve = std::variant<LineCurve, ArcCurve, ParabolaCurve, SineCurve, PointsCurve>;

/// @brief Reaction p of an elastic support as a function of its penetration w >= 0; p(-w) = -p(w) for
/// bilateral supports. Force for springs, force per undeformed length for foundations.
///
/// Unloading follows the curve back.
struct ReactionLaw {
  enum class Type {
    linear,      ///< p = stiffness w
    tanh,        ///< p = capacity tanh(stiffness w / capacity)
    hyperbolic,  ///< p = w / (1 / stiffness + w / capacity)
    power,       ///< p = min(stiffness w, capacity (w / reference)^exponent, capacity)
    table        ///< p = factor times a curve through `points`, constant beyond the last
  };
  using Interpolation = snapthrough::Interpolation;
  Type type = Type::linear;
  AlongMember stiffness;                      ///< slope at w = 0
  AlongMember capacity;                       ///< largest p
  double reference = 0.0;                     ///< w at which the power reaches the capacity
  double exponent = 0.5;                      ///< in (0, 1)
  std::vector<std::array<double, 2>> points;  ///< (w, p) from the origin on, which may be left out; w
                                              ///< ascends, p may fall after its largest value
  Interpolation interpolation = Interpolation::monotone_cubic;
  AlongMember factor = 1.0;
  bool operator==(const ReactionLaw&) const = default;
};

/// @brief Force that a member, or a spring between two nodes, has on the undeformed structure, or its length
/// without force; exactly one of the two is given.
struct Pretension {
  std::optional<double> force = {};              ///< tension positive
  std::optional<double> unstressed_length = {};  ///< > 0
  bool operator==(const Pretension&) const = default;
};

struct Member {
  std::string id;
  std::string start;    ///< node id
  std::string end;      ///< node id
  std::string section;  ///< section id
  Curve curve;
  bool release_start_rotation = false;
  bool release_end_rotation = false;
  /// Moment per radian of relative rotation of a released end and its node, >= 0; 0: hinge.
  double release_start_stiffness = 0.0;
  double release_end_stiffness = 0.0;
  /// Moment as a function of the relative rotation of a released end and its node, in place of its stiffness;
  /// the law's numbers do not vary.
  std::optional<ReactionLaw> release_start_law = std::nullopt;
  std::optional<ReactionLaw> release_end_law = std::nullopt;
  /// One-sided: a rod, straight and hinged at both ends, whose axial force is a compression or a tension
  /// only.
  Reaction reaction = Reaction::bilateral;
  std::optional<Pretension> pretension = std::nullopt;
  /// A rod that only pulls, and hangs between its nodes in an elastic catenary under its constant self
  /// weight.
  bool cable = false;
  bool operator==(const Member&) const = default;
};
[[nodiscard]] inline bool is_rod(const Member& member) { return member.reaction != Reaction::bilateral; }
/// Whether the start of a member turns without resistance of its node.
[[nodiscard]] inline bool is_hinged_at_start(const Member& member) {
  return is_rod(member) || (member.release_start_rotation && member.release_start_stiffness == 0.0 &&
                            !member.release_start_law);
}
[[nodiscard]] inline bool is_hinged_at_end(const Member& member) {
  return is_rod(member) ||
         (member.release_end_rotation && member.release_end_stiffness == 0.0 && !member.release_end_law);
}

struct PrescribedDisplacement {
  double x = 0.0;
  double y = 0.0;
  double rotation = 0.0;
  Pattern pattern = Pattern::proportional;
  bool operator==(const PrescribedDisplacement&) const = default;
};

struct Support {
  std::string node;
  bool x = false;
  bool y = false;
  bool rotation = false;
  double angle_degrees = 0.0;  ///< turns the support's x and y axes
  std::optional<PrescribedDisplacement> displacement;
  bool operator==(const Support&) const = default;
};

/// Cable that hangs between two nodes under its weight.
struct Cable {
  double axial_stiffness = 0.0;            ///< > 0
  double length = 0.0;                     ///< length without force, > 0
  std::array<double, 2> weight{0.0, 0.0};  ///< force per length without force, not zero
  bool operator==(const Cable&) const = default;
};

/// Discrete spring to ground, or between two nodes. `direction` points into the medium, or into what `to`
/// belongs to; empty: rotational spring.
struct Spring {
  std::string id;
  Location at;
  std::optional<std::array<double, 2>> direction;
  double stiffness = 0.0;  ///< force per length, or moment per radian; >= 0; infinite: a one-sided stop
  Reaction reaction = Reaction::bilateral;
  double gap = 0.0;  ///< displacement at which a one-sided spring begins to react, >= 0
  std::optional<ReactionLaw> law = std::nullopt;  ///< in place of `stiffness`; its numbers do not vary
  /// Node at the other end: the spring reacts on the displacement of `at` relative to that node. Empty: the
  /// other end is the ground.
  std::optional<Location> to = std::nullopt;
  /// Displacement of the ground in global axes: the spring reacts on the displacement of `at` relative to it.
  std::optional<PrescribedDisplacement> displacement = std::nullopt;
  /// Index of the member that the spring stands for: see with_rods_as_springs(). `direction` is then the
  /// vector from `at` to `to`, and turns with both.
  std::optional<std::size_t> rod = std::nullopt;
  std::optional<double> strength = std::nullopt;  ///< axial force that yields a rod at its weakest place
  std::optional<Pretension> pretension = std::nullopt;  ///< only with `to`, along the line between the nodes
  /// Lengthening by temperature of a spring that stands for a member: constant, and per load factor.
  std::array<double, 2> lengthening{0.0, 0.0};
  /// Cable that the spring stands for; it is bilateral then, and half of the cable's weight acts at each
  /// node.
  std::optional<Cable> cable = std::nullopt;
  bool operator==(const Spring&) const = default;
};

/// Surfaces of a medium, in the model's coordinates.
struct CircleOutline {
  std::array<double, 2> centre{0.0, 0.0};
  double radius = 0.0;         ///< > 0
  bool medium_inside = false;  ///< false: the medium surrounds the circle
  bool operator==(const CircleOutline&) const = default;
};
struct LineOutline {
  std::array<double, 2> through{0.0, 0.0};
  std::array<double, 2> into{0.0, 0.0};  ///< normal that points into the medium, of any length but zero
  bool operator==(const LineOutline&) const = default;
};
/// C2 cubic spline through points, continued straight at both ends.
struct SplineOutline {
  std::vector<std::array<double, 2>> points;
  Side medium = Side::left;  ///< side on which the medium lies, in the order of the points
  bool operator==(const SplineOutline&) const = default;
};
/// Straight lines through points, continued at both ends, whose corners are arcs.
struct PolylineOutline {
  std::vector<std::array<double, 2>> points;
  double rounding = 0.0;  ///< radius of the arcs, > 0
  Side medium = Side::left;
  bool operator==(const PolylineOutline&) const = default;
};
using Outline = std::variant<CircleOutline, LineOutline, SplineOutline, PolylineOutline>;

/// Displacement of the ground along a member, in global axes.
struct GroundDisplacement {
  AlongMember x = 0.0;
  AlongMember y = 0.0;
  Pattern pattern = Pattern::proportional;
  bool operator==(const GroundDisplacement&) const = default;
};

/// End of the ground beside a foundation: it ends free, or it goes on without end.
enum class GroundEnd { free, endless };

/// What a foundation resists: the displacement along the member's initial normal, that along its initial
/// tangent, or the rotation of its sections.
enum class FoundationComponent { normal, tangent, rotation };

/// Continuous foundation r = K w - G w'' per undeformed length, w the displacement along the initial normal
/// (towards `side`) or along the fixed `direction` (pointing into the medium), or what `component` says.
/// Against rotation, r is a moment per length and K a moment per length and radian.
struct Foundation {
  std::string id;
  std::string member;
  /// K, force per length squared, >= 0; infinite: a one-sided foundation that nothing enters.
  double stiffness = 0.0;
  double shear_stiffness = 0.0;  ///< G, force, >= 0
  Reaction reaction = Reaction::bilateral;
  Side side = Side::left;
  std::array<double, 2> range{0.0, 1.0};
  double gap = 0.0;
  std::optional<std::array<double, 2>> direction;
  std::optional<ReactionLaw> law = std::nullopt;  ///< in place of `stiffness`
  Along<double> gap_along = {};
  /// Surface of a one-sided foundation: w is the depth of each point below the surface, whose reaction is
  /// normal to the surface at its nearest point. `side` and `direction` are not used then.
  std::optional<Outline> outline = std::nullopt;
  /// But along the normal, a foundation is bilateral and has no G, and `side` and `direction` are not used.
  FoundationComponent component = FoundationComponent::normal;
  /// w is the displacement relative to this one, and an outline moves with it.
  std::optional<GroundDisplacement> displacement = std::nullopt;
  /// What the ground with the shear layer of a one-sided foundation does at the ends of the range.
  GroundEnd ground_end = GroundEnd::free;
  bool operator==(const Foundation&) const = default;
};

[[nodiscard]] inline bool has_one_sided_layer(const Foundation& foundation) {
  return foundation.reaction != Reaction::bilateral && foundation.shear_stiffness > 0.0;
}

struct PointLoad {
  Location at;
  std::array<double, 2> force{0.0, 0.0};
  double moment = 0.0;
  Pattern pattern = Pattern::proportional;
  bool follows = false;  ///< the force turns with the rotation of its place
  /// The force stays on its line of action on the undeformed structure; it acts on a rigid plate at its
  /// place.
  bool fixed_line = false;
  bool operator==(const PointLoad&) const = default;
};
/// Whether a force acts as it does on the undeformed structure.
[[nodiscard]] inline bool is_dead(const PointLoad& load) { return !load.follows && !load.fixed_line; }
/// Dead load per undeformed or projected length.
struct DistributedLoad {
  std::string member;
  std::array<double, 2> force{0.0, 0.0};
  std::array<double, 2> range{0.0, 1.0};
  LoadMeasure per = LoadMeasure::length;
  Pattern pattern = Pattern::proportional;
  LoadAxes axes = LoadAxes::global;
  Along<std::array<double, 2>> force_along = {};
  bool operator==(const DistributedLoad&) const = default;
};
/// Follower pressure per deformed length, pushing from `side`.
struct PressureLoad {
  std::string member;
  double value = 0.0;
  Side side = Side::left;
  Pattern pattern = Pattern::proportional;
  Along<double> value_along = {};
  bool operator==(const PressureLoad&) const = default;
};
struct InitialStrain {
  std::string member;
  double axial = 0.0;
  double curvature = 0.0;
  Pattern pattern = Pattern::proportional;
  Along<double> axial_along = {};
  Along<double> curvature_along = {};
  bool operator==(const InitialStrain&) const = default;
};
/// Weight of all members: `Section::mass` times `gravity`, a dead load per undeformed length.
struct SelfWeight {
  std::array<double, 2> gravity{0.0, 0.0};  ///< acceleration in global axes
  Pattern pattern = Pattern::proportional;
  bool operator==(const SelfWeight&) const = default;
};
/// Strain by temperature: axial expansion * change, curvature -expansion * gradient.
struct TemperatureLoad {
  std::string member;
  double change = 0.0;    ///< change of temperature of the axis
  double gradient = 0.0;  ///< change per length along the left normal
  Pattern pattern = Pattern::proportional;
  Along<double> change_along = {};
  Along<double> gradient_along = {};
  bool operator==(const TemperatureLoad&) const = default;
};
using Load =
    std::variant<PointLoad, DistributedLoad, PressureLoad, InitialStrain, SelfWeight, TemperatureLoad>;
/// Named group of loads. Their amounts contain its factor, and their pattern says whether it grows.
struct LoadCase {
  std::string id;
  std::size_t loads = 0;  ///< number of its loads
  bool operator==(const LoadCase&) const = default;
};

/// Stress-free offset amplitude * sin(half_waves pi s / L) along the left normal.
struct SineImperfection {
  std::string member;
  int half_waves = 1;
  double amplitude = 0.0;
  bool operator==(const SineImperfection&) const = default;
};
/// Linearised buckling mode (1 is the lowest) scaled to the largest offset `amplitude`.
struct ModeImperfection {
  int number = 1;
  double amplitude = 0.0;
  bool operator==(const ModeImperfection&) const = default;
};
/// Stress-free offsets at fractions of the length, interpolated by a C2 spline.
struct PointsImperfection {
  std::string member;
  std::vector<std::array<double, 2>> offsets;
  bool operator==(const PointsImperfection&) const = default;
};
/// Norm of the stress-free offsets w(s) of all members: root mean square over their length, or largest |w|.
enum class OffsetNorm { rms, max };
/// Offsets of a given norm that lower the first critical load most, among the splines of OffsetSpace; solve()
/// replaces it by a PointsImperfection of each member. At most one per model.
struct WorstImperfection {
  OffsetNorm norm = OffsetNorm::rms;
  double amplitude = 0.0;  ///< norm of the offsets, > 0
  bool operator==(const WorstImperfection&) const = default;
};
using Imperfection = std::variant<SineImperfection, ModeImperfection, PointsImperfection, WorstImperfection>;

/// Mass at a place, for vibration. Self weight does not include it.
struct PointMass {
  Location at;
  double mass = 0.0;     ///< >= 0
  double inertia = 0.0;  ///< moment of inertia about the place, >= 0
  bool operator==(const PointMass&) const = default;
};

/// Viscous damping  mass M + stiffness K,  K the elastic stiffness of members and their joints.
struct Damping {
  double mass = 0.0;       ///< >= 0, per time
  double stiffness = 0.0;  ///< >= 0, time
  bool operator==(const Damping&) const = default;
};
[[nodiscard]] inline bool is_damped(const Damping& damping) {
  return damping.mass > 0.0 || damping.stiffness > 0.0;
}

struct Monitor {
  std::string id;
  Location at;
  Component component = Component::y;
  bool operator==(const Monitor&) const = default;
};

struct Model {
  std::string title;
  std::vector<std::pair<std::string, std::string>> units;  ///< labels, echoed, never interpreted
  std::vector<Node> nodes;
  std::vector<Section> sections;
  std::vector<Member> members;
  std::vector<Support> supports;
  std::vector<Spring> springs;
  std::vector<Foundation> foundations;
  std::vector<Load> loads;  ///< loads of load cases stand last, case by case
  std::vector<LoadCase> load_cases;
  std::vector<Imperfection> imperfections;
  std::vector<PointMass> masses;
  Damping damping;  ///< damps vibrations where flutter is looked for
  std::vector<Monitor> monitors;
  bool operator==(const Model&) const = default;
};

}  // namespace snapthrough
