#pragma once
/// @file
/// What an analysis gives back. Plain data, one field for each field of the result document. Counts that were
/// not filled stay at -1, numbers that do not exist are empty optionals.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace snapthrough {

/// broken_bifurcation: a bifurcation beside the path, which passes it by because of an imperfection.
enum class CriticalType { bifurcation, limit_max, limit_min, broken_bifurcation };

[[nodiscard]] constexpr bool is_limit(CriticalType type) {
  return type == CriticalType::limit_max || type == CriticalType::limit_min;
}
/// Why stability changes at a point: an eigenvalue passes zero, or a support that begins or ceases to act
/// changes the stiffness at once.
enum class CriticalCause { smooth, contact };

/// A named series, one value for each point of a branch (or one value at a point).
struct NamedSeries {
  std::string id;
  std::vector<double> values;
};
struct NamedValue {
  std::string id;
  double value = 0.0;
};

/// Why a critical load has no derivative by a number of the model.
enum class NoDerivative {
  breaks_bifurcation,  ///< the path no longer meets it: its limit point goes by a power less than one
  contact,             ///< a support that begins or ceases to act makes the point, not an eigenvalue
  multiple,            ///< several eigenvalues vanish, and go apart
  unsymmetric,         ///< follower pressure on a free end: the tangent has other left null vectors
  not_differentiable,  ///< the equations have a kink or a jump there
  not_found            ///< the point could not be found again to rounding
};

/// d load factor / d value of a number of the model, the load factor's and the value's units as given.
struct Sensitivity {
  std::string pointer;
  std::optional<double> derivative;
  std::optional<NoDerivative> reason;  ///< where there is none
};

/// How the path that crosses at a bifurcation leaves it.
enum class BifurcationKind { asymmetric, stable_symmetric, unstable_symmetric };

/// load_factor = critical (1 + a s + b s^2) along that path, s the amplitude of the mode, a length.
struct KoiterCoefficients {
  double a = 0.0;           ///< exactly 0 where the bifurcation is symmetric
  std::optional<double> b;  ///< where it is
  BifurcationKind kind = BifurcationKind::asymmetric;
};

/// What one mesh said of a critical point.
struct MeshAnswer {
  int elements = -1;
  int order = -1;
  std::optional<double> load_factor;  ///< empty: the point was not found there
};

/// Displacements of a member in a mode, over its arc length.
struct MemberMode {
  std::string id;
  std::vector<double> s, u, v, rotation;
};
/// A buckling mode or a direction of a path: the largest displacement hypot(u, v) is 1, the first large
/// component positive; rotations in the same scale.
struct Mode {
  std::vector<MemberMode> members;
};

struct CriticalPoint {
  int branch = 0;
  CriticalType type = CriticalType::bifurcation;
  double load_factor = 0.0;
  std::optional<double> error_estimate;  ///< relative; empty: none was made
  double arc_length = 0.0;
  std::vector<NamedValue> monitors;
  int negative_before = -1;  ///< negative eigenvalues of the constrained tangent before the point
  int negative_after = -1;
  int multiplicity = 1;      ///< how many eigenvalues vanish there
  std::optional<int> state;  ///< index into Result::states
  CriticalCause cause = CriticalCause::smooth;
  /// Null vector of the tangent stiffness; at a limit point that is the path's direction. With the state
  /// only.
  std::optional<Mode> mode = {};
  bool confirmed = false;  ///< a second, finer mesh has the point within the accuracy that was asked for
  std::vector<MeshAnswer> meshes = {};  ///< coarsest first
  /// Of a bifurcation: the size of what breaks it, about the root mean square slope of the imperfection's
  /// shape; empty: not measured.
  std::optional<double> imperfection = {};
  std::vector<Sensitivity> sensitivities = {};  ///< in the order asked
  std::optional<KoiterCoefficients> koiter = {};
  /// Id of the member whose own buckling the point is: the motion lost there bends that member alone.
  std::optional<std::string> member = {};
  /// d monitor / d load factor along the path, length or rad; empty: no finite rate is known (see the
  /// schema).
  std::vector<NamedValue> monitor_rate = {};
};

/// A displacement of a node.
struct NodeMotion {
  std::string node;
  double u = 0.0, v = 0.0, rotation = 0.0;
};

/// A motion that nothing resists, held by the least norm while it is free.
struct NeutralMotion {
  int branch = 0;
  double from = 0.0;              ///< load factor where it becomes free
  std::optional<double> to;       ///< where something resists it again; empty: free to the end of the path
  std::vector<NodeMotion> nodes;  ///< those that move; the largest displacement is 1, or the largest rotation
                                  ///< where none is displaced
};

/// A contact zone of a foundation, or a one-sided spring, that begins or ends. Zones that divide or join
/// count too: with `zones` before and after.
struct ContactEvent {
  int branch = 0;
  std::string id;  ///< of the foundation or spring
  bool opened = false;
  double load_factor = 0.0;
  double arc_length = 0.0;
  int zones_before = 0;
  int zones_after = 0;
};

struct Branch {
  int id = 0;
  std::optional<int> parent;
  std::vector<double> load_factor;
  std::vector<double> arc_length;  ///< dimensionless, from 0, increasing
  std::vector<NamedSeries> monitors;
  std::vector<int> negative_eigenvalues;
  /// Least stiffness over that of the unloaded structure; empty: not known at that point.
  std::vector<std::optional<double>> stiffness_ratio;
  std::vector<NamedSeries> contact_fraction;  ///< foundation id, fraction of its range in contact
  std::string termination = {};               ///< code as in Summary
};

/// Force and moment about the origin of the model's axes, at the deformed positions; at the undeformed ones
/// when the geometry is linear, as equilibrium is stated there.
struct Resultant {
  double fx = 0.0;
  double fy = 0.0;
  double moment = 0.0;
};

/// Values at equally spaced places of a member: x0, y0 undeformed positions (imperfections included), x, y
/// deformed ones, u, v displacements in global axes.
struct MemberState {
  std::string id;
  std::vector<double> s, x0, y0, x, y, u, v, rotation, axial_force, shear_force, bending_moment;
};
/// Reaction of a support on the structure, in global axes, moment about its node.
struct SupportState {
  std::string node;
  double fx = 0.0;
  double fy = 0.0;
  double moment = 0.0;
};
struct SpringState {
  std::string id;
  double force = 0.0;  ///< pressing on the structure against the spring's direction; a pull is negative
  double displacement = 0.0;  ///< along its direction; the rotation for a rotational spring
  bool closed = false;        ///< whether it acts
  Resultant resultant;        ///< on the structure
};
struct FoundationState {
  std::string id;
  std::vector<double> s, reaction;
  std::vector<double> displacement;            ///< into the medium
  std::vector<std::array<double, 2>> contact;  ///< intervals [s0, s1] in contact, in the member's s
  Resultant resultant;                         ///< of the medium on the structure, shear layer included
};
/// A state in equilibrium: reactions of supports (with their nodes' positions), resultants of springs,
/// foundations and loads add up to nothing.
struct State {
  int branch = 0;
  double load_factor = 0.0;
  int refinements = 0;  ///< of the path's mesh, to the mesh that this state is in equilibrium on
  std::vector<MemberState> members;
  std::vector<SupportState> supports;
  std::vector<SpringState> springs;
  std::vector<FoundationState> foundations;
  Resultant loads;  ///< of all loads that act in the state
};

/// Equilibrium at load factors that were asked for, in that order; those that were reached.
struct StaticTable {
  std::vector<double> load_factor;
  std::vector<NamedSeries> monitors;
  std::vector<std::optional<int>> negative_eigenvalues;
  std::vector<NamedSeries> contact_fraction;  ///< foundation id, fraction of its range in contact
  std::vector<std::optional<int>> state;      ///< index into Result::states
};

/// An extreme value and where it is.
struct Extreme {
  double value = 0.0;
  double s = 0.0;
  int branch = 0;
  double load_factor = 0.0;
};
struct ExtremeRange {
  Extreme min;
  Extreme max;
};
struct MemberExtremes {
  std::string id;
  ExtremeRange axial_force;
  ExtremeRange shear_force;
  ExtremeRange bending_moment;
  Extreme displacement;  ///< largest hypot(u, v)
};

/// Something that the reader of a result has to know. Codes: "large_strain", "path_points",
/// "touching_supports", "touching_eigenvalue", "contact_changes".
struct Warning {
  std::string code;
  std::string detail;
};

struct BucklingResult {
  std::vector<double> load_factors;
  std::vector<std::optional<double>> error_estimates;  ///< relative, one a load factor
  std::vector<Mode> modes;
};

/// Where the structure is softest before it loses stability.
struct Softest {
  double load_factor = 0.0;
  double stiffness_ratio = 0.0;  ///< least stiffness over that of the unloaded structure
  std::optional<Mode> mode;      ///< motion with that stiffness
};

/// How far the structure has moved where it loses stability.
struct AtCritical {
  double displacement = 0.0;           ///< largest hypot(u, v)
  double relative_displacement = 0.0;  ///< over the diagonal of the structure's bounding box
  double rotation = 0.0;               ///< largest, rad
  double strain = 0.0;                 ///< largest of |N| / EA, |Q| / GA, |M| / EI times sqrt(EI / EA)
};

struct Summary {
  std::optional<double> critical_load_factor;
  std::optional<CriticalType> critical_type;
  std::optional<double> error_estimate;
  std::string termination;  ///< code of the stop rule that ended the search, e.g. "limit_points", "steps"
  std::string message;      ///< a sentence with the deciding numbers
  /// The first local minimum of the stiffness ratio below a tenth before the critical load, else the lowest;
  /// where there is no minimum, the critical point itself; empty where neither was met.
  std::optional<Softest> softest = {};
  std::optional<AtCritical> at_critical = {};
};

struct MeshReport {
  int elements = -1;
  int order = -1;
  int unknowns = -1;  ///< free displacement unknowns, element interiors included
  int refinements = -1;
  std::optional<double> requested_accuracy;
  std::optional<double> estimated_accuracy;
  /// Paths followed, the last of them reported; each but the first on the mesh before with every element cut
  /// in four or more, because finer meshes did not confirm what was found.
  int paths = 1;
  /// Where the elements of the reported path's own mesh end along each member, in fractions of it; empty for
  /// analyses that follow no path.
  std::vector<std::vector<double>> ends;
};

struct Diagnostics {
  int steps = -1;
  int rejected_steps = -1;
  int iterations = -1;
  int factorizations = -1;
  double max_relative_residual = -1.0;
  std::vector<std::string> skipped;      ///< what the model did not need, in words
  std::array<int, 32> corrections = {};  ///< entry i: steps that took i Newton corrections, 31 for more
};

/// A numerical failure: what could not be done and where it stood. The rest of the result holds what was
/// reached.
struct Failure {
  std::string code;  ///< "no_convergence", "step_underflow", "cancelled", "no_start", "not_held", ...
  std::string detail;
};

struct Result {
  Summary summary;
  std::vector<CriticalPoint> critical_points;
  std::vector<NeutralMotion> neutral_motion;
  std::vector<ContactEvent> contact_events;
  std::vector<Branch> branches;
  std::vector<State> states;
  std::optional<StaticTable> static_table;
  std::vector<double> not_reached;  ///< load factors that were asked for
  std::optional<BucklingResult> buckling;
  std::optional<std::vector<MemberExtremes>> extremes;  ///< when asked for; empty: no state was reached
  std::vector<Warning> warnings;
  MeshReport discretization;
  Diagnostics diagnostics;
  std::optional<Failure> failure;
};

}  // namespace snapthrough
