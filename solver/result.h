#pragma once
/// @file
/// Result of an analysis. Plain data, one field for each field of the result document. Unset counts are -1;
/// numbers that do not exist are empty.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace snapthrough {

/// Type of a critical point. broken_bifurcation: missed by the path because of an imperfection. flutter: two
/// natural frequencies meet under loads without a potential, and vibrations grow beyond. capacity: supports
/// whose laws have a capacity carry no more, see CapacityLimit.
enum class CriticalType { bifurcation, limit_max, limit_min, broken_bifurcation, flutter, capacity };

[[nodiscard]] constexpr bool is_limit(CriticalType type) {
  return type == CriticalType::limit_max || type == CriticalType::limit_min;
}
/// Cause of a change of stability: an eigenvalue crosses zero; contact changes the stiffness abruptly; or the
/// freedoms without mass lose their stability, so that the square of a natural frequency becomes infinite and
/// returns from minus infinity.
enum class CriticalCause { smooth, contact, massless };

/// Named series with one value for each point of a branch or row of a table.
struct NamedSeries {
  std::string id;
  std::vector<double> values;
};
struct NamedValue {
  std::string id;
  double value = 0.0;
};

/// Reason why a critical load has no derivative with respect to a number of the model.
enum class NoDerivative {
  breaks_bifurcation,  ///< the change breaks the bifurcation; the load then varies with a power below one
  contact,             ///< contact, not an eigenvalue, causes the point
  multiple,            ///< several eigenvalues vanish and would separate
  unsymmetric,         ///< follower pressure on a free end: nonsymmetric tangent
  not_differentiable,  ///< the equations have a kink or a jump there
  not_found            ///< the point could not be solved to rounding
};

/// Derivative d load factor / d value of a number of the model, in given units.
struct Sensitivity {
  std::string pointer;
  std::optional<double> derivative;
  std::optional<NoDerivative> reason;  ///< why the derivative does not exist
};

/// Type of the path that crosses at a bifurcation.
enum class BifurcationKind { asymmetric, stable_symmetric, unstable_symmetric };

/// load_factor = critical (1 + a s + b s^2) on the crossing path, s the amplitude of the mode, a length.
struct KoiterCoefficients {
  double a = 0.0;           ///< exactly 0 for symmetric bifurcations
  std::optional<double> b;  ///< for symmetric bifurcations only
  BifurcationKind kind = BifurcationKind::asymmetric;
};

/// Load of a critical point on one mesh.
struct MeshAnswer {
  int elements = -1;
  int order = -1;
  std::optional<double> load_factor;  ///< empty: the mesh does not have the point
};

/// Displacements of a member in a mode over its arc length.
struct MemberMode {
  std::string id;
  std::vector<double> s, u, v, rotation;
};
/// Length of a pinned column with the bending stiffness of a member and its axial force at a buckling load.
struct EffectiveLength {
  std::string id;  ///< member
  std::optional<double>
      length;  ///< pi sqrt(EI / N); empty: tension, little compression, or EI varies, or a bending law
  std::optional<double> ratio;  ///< length over the length of the member's axis
};

/// Buckling mode or direction of a path: largest displacement hypot(u, v) 1, first large component positive;
/// rotations in the same scale.
struct Mode {
  std::vector<MemberMode> members;
  std::vector<EffectiveLength> effective_lengths = {};  ///< buckling modes have them; empty for other motions
};

struct CriticalPoint {
  int branch = 0;
  CriticalType type = CriticalType::bifurcation;
  double load_factor = 0.0;
  std::optional<double> error_estimate;  ///< relative; empty: not estimated
  double arc_length = 0.0;
  std::vector<NamedValue> monitors;
  int negative_before = -1;  ///< negative eigenvalues of the constrained tangent before the point
  int negative_after = -1;
  int multiplicity = 1;      ///< number of eigenvalues that vanish there
  std::optional<int> state;  ///< index into Result::states
  CriticalCause cause = CriticalCause::smooth;
  /// Null vector of the tangent stiffness; at a limit point the path's direction. Only together with `state`.
  std::optional<Mode> mode = {};
  bool confirmed = false;               ///< a finer mesh has the point within the requested accuracy
  bool after_growth = false;            ///< vibrations grow from an earlier point of the path on
  std::vector<MeshAnswer> meshes = {};  ///< loads on the compared meshes, coarsest first
  /// Imperfection of a bifurcation, about the root mean square slope of the imperfect shape; empty: unknown.
  std::optional<double> imperfection = {};
  std::vector<Sensitivity> sensitivities = {};  ///< in the order of the request
  std::optional<KoiterCoefficients> koiter = {};
  /// Id of the member that buckles by itself: the mode bends that member alone.
  std::optional<std::string> member = {};
  /// d monitor / d load factor along the path, length or rad; empty: no finite rate is known (see the
  /// schema).
  std::vector<NamedValue> monitor_rate = {};
};

/// Displacement of a node.
struct NodeMotion {
  std::string node;
  double u = 0.0, v = 0.0, rotation = 0.0;
};

/// Motion without stiffness, pinned in the state of least norm while it is free.
struct NeutralMotion {
  int branch = 0;
  double from = 0.0;  ///< load factor at which the motion becomes free
  /// Load factor at which the motion meets resistance again; empty: free to the end of the path.
  std::optional<double> to;
  std::vector<NodeMotion> nodes;  ///< moving nodes; largest displacement 1, or largest rotation 1
};

/// Limit load of supports whose laws have a capacity: the motion that the loads drive there meets supports at
/// their capacity only.
struct CapacityLimit {
  double load_factor = 0.0;           ///< no equilibrium is reported beyond this load factor
  std::vector<std::string> supports;  ///< ids of the springs and foundations at their capacity
  std::vector<NodeMotion> nodes;      ///< moving nodes; largest displacement 1, or largest rotation 1
};

/// Beginning or end of a contact zone of a foundation, or of contact of a one-sided spring; also division and
/// union of zones, by `zones_before` and `zones_after`.
struct ContactEvent {
  int branch = 0;
  std::string id;  ///< id of the foundation or spring
  bool opened = false;
  double load_factor = 0.0;
  double arc_length = 0.0;
  int zones_before = 0;
  int zones_after = 0;
};

/// Lowest eigenvalues mu = omega^2 of small free vibrations about a state, by ascending real part.
struct Frequencies {
  std::vector<double> squares;  ///< real parts of omega^2, (rad per unit of time)^2; negative: divergence
  /// Imaginary parts; not zero for a pair that flutters. Empty where the loads have a potential.
  std::vector<double> imaginary = {};
};

/// Rates along a branch by its arc length, one for each row: with the values at both ends of two neighbouring
/// rows they give the cubic that is the path between both.
struct PathRates {
  std::vector<double> load_factor;
  std::vector<NamedSeries> monitors;
};

/// The lists have one value for each row, but for `computed`.
struct Branch {
  int id = 0;
  std::optional<int> parent;
  std::vector<double> load_factor;
  std::vector<double> arc_length;  ///< dimensionless, from 0, increasing
  std::vector<NamedSeries> monitors;
  std::vector<int> negative_eigenvalues;
  /// Least stiffness over that of the unloaded structure at each point; empty: unknown, as between computed
  /// points.
  std::vector<std::optional<double>> stiffness_ratio;
  std::vector<NamedSeries> contact_fraction;  ///< foundation id, fraction of its range in contact
  /// If requested; empty: a support touches there without pressure, or the row is not computed.
  std::vector<std::optional<Frequencies>> frequencies = {};
  /// Indices of the rows at which an equilibrium was solved; the others are points of the cubics between
  /// them.
  std::vector<int> computed = {};
  std::optional<PathRates> rates = {};  ///< empty in results of earlier versions
  std::string termination = {};         ///< code as in Summary
};

/// Force, and moment about the axes' origin, at the deformed positions (linear geometry: undeformed).
struct Resultant {
  double fx = 0.0;
  double fy = 0.0;
  double moment = 0.0;
};

/// Value at a place of a member.
struct Peak {
  double value = 0.0;
  double s = 0.0;
};
struct PeakRange {
  Peak min;
  Peak max;
};
/// Outer fibre of a member, on the left or right of its axis as seen from its start to its end.
enum class Fibre { left, right };
/// Stress over strength in an outer fibre, with the sign of the stress: positive in tension.
struct Utilisation {
  double value = 0.0;
  double s = 0.0;
  Fibre fibre = Fibre::left;
};
/// Extreme values along a whole member in one state, between the places of its lists too.
struct MemberPeaks {
  PeakRange axial_force;
  PeakRange shear_force;
  PeakRange bending_moment;
  Peak displacement;                            ///< largest hypot(u, v)
  std::optional<Utilisation> utilisation = {};  ///< largest in size; empty: the section has no strength
};
/// Values at equally spaced positions of a member: x0, y0 undeformed (with imperfections), x, y deformed; u,
/// v displacements in global axes.
struct MemberState {
  std::string id;
  std::vector<double> s, x0, y0, x, y, u, v, rotation, axial_force, shear_force, bending_moment;
  /// Stress over strength in the outer fibres, positive in tension; empty: the section has no strength.
  std::vector<double> utilisation_left = {}, utilisation_right = {};
  MemberPeaks extremes = {};
};
/// Reaction of a support on the structure in global axes; moment about its node.
struct SupportState {
  std::string node;
  double fx = 0.0;
  double fy = 0.0;
  double moment = 0.0;
};
struct SpringState {
  std::string id;
  double force = 0.0;         ///< force on the structure against the spring's direction; negative for a pull
  double displacement = 0.0;  ///< along the direction; for a rotational spring the rotation
  bool closed = false;        ///< the spring acts
  Resultant resultant;        ///< force on the structure
  std::optional<double> mobilised = {};  ///< |force| over the capacity of the law; empty: it has none
};
struct FoundationState {
  std::string id;
  std::vector<double> s, reaction;
  std::vector<double> displacement;            ///< displacement into the medium
  std::vector<std::array<double, 2>> contact;  ///< intervals [s0, s1] in contact, in the member's s
  Resultant resultant;                         ///< force of the medium on the structure, with the shear layer
  PeakRange extremes = {};                     ///< extremes of the reaction along the whole range
  std::vector<double> mobilised = {};          ///< |reaction| over the law's capacity; empty: it has none
};
/// Equilibrium state: reactions and the resultants of springs, foundations and loads sum to zero.
/// Tangent stiffness of a place at a state: a node, or a place of a member.
struct PlaceStiffness {
  std::optional<std::string> node = {};
  std::optional<std::string> member = {};
  std::optional<double> fraction = {};
  /// Rows: force along x, along y, moment; columns: displacement along x, along y, rotation. Everything else
  /// is free, and the load factor stays. Empty where a support holds the place, or nothing resists its
  /// motion.
  std::optional<std::vector<std::array<double, 3>>> tangent = {};
};
struct State {
  int branch = 0;
  double load_factor = 0.0;
  int refinements = 0;  ///< refinements from the path's mesh to the mesh of this state
  /// Estimated relative error of a path's state at an asked load factor, see relative_error(); empty: not
  /// estimated, or not confirmed.
  std::optional<double> error_estimate;
  std::vector<MemberState> members;
  std::vector<SupportState> supports;
  std::vector<SpringState> springs;
  std::vector<FoundationState> foundations;
  Resultant loads;                                ///< resultant of all loads in the state
  std::vector<PlaceStiffness> stiffness_at = {};  ///< for OutputOptions::stiffness_at
};

/// Equilibria at the requested load factors that were reached, in the order of the request.
struct StaticTable {
  std::vector<double> load_factor;
  std::vector<NamedSeries> monitors;
  std::vector<std::optional<int>> negative_eigenvalues;
  std::vector<NamedSeries> contact_fraction;  ///< foundation id, fraction of its range in contact
  std::vector<std::optional<int>> state;      ///< index into Result::states
  std::vector<std::optional<Frequencies>> frequencies = {};  ///< entries as in Branch::frequencies
};

/// Small free vibrations about the equilibrium at a load factor.
struct Vibration {
  double load_factor = 0.0;
  Frequencies frequencies;
  std::vector<std::optional<double>> error_estimates;  ///< absolute, for omega^2; empty: not estimated
  std::vector<Mode> modes;  ///< two for a pair that flutters: real and imaginary part
};

/// Extreme value with its position.
struct Extreme {
  double value = 0.0;
  double s = 0.0;
  int branch = 0;
  double load_factor = 0.0;
};
struct UtilisationExtreme {
  Utilisation place;
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
  Extreme displacement;                                ///< largest hypot(u, v)
  std::optional<UtilisationExtreme> utilisation = {};  ///< largest in size; empty: no strength is given
};

/// First state of the primary path in which the stress of an outer fibre reaches its strength.
struct FirstYield {
  double load_factor = 0.0;
  std::optional<double> error_estimate;  ///< relative; empty: not estimated
  double arc_length = 0.0;
  std::string member;
  Utilisation place = {};  ///< value 1 in tension, -1 in compression
  std::vector<NamedValue> monitors;
};

/// Warning for the reader of a result. `code` is one of those that the OpenAPI document lists at
/// Result.warnings.
struct Warning {
  std::string code;
  std::string detail;
};

struct BucklingResult {
  std::vector<double> load_factors;
  std::vector<std::optional<double>> error_estimates;  ///< relative, one per load factor
  std::vector<Mode> modes;
};

/// State of least stiffness before stability is lost.
struct Softest {
  double load_factor = 0.0;
  double stiffness_ratio = 0.0;  ///< least stiffness over that of the unloaded structure
  std::optional<Mode> mode;      ///< motion with that stiffness
};

/// Displacements of the structure at its loss of stability.
struct AtCritical {
  double displacement = 0.0;           ///< largest hypot(u, v)
  double relative_displacement = 0.0;  ///< over the diagonal of the structure's bounding box
  double rotation = 0.0;               ///< largest rotation, rad
  double strain = 0.0;                 ///< largest of |N| / EA, |Q| / GA, curvature times sqrt(EI / EA)
};

struct Summary {
  std::optional<double> critical_load_factor;
  std::optional<CriticalType> critical_type;
  std::optional<double> error_estimate;
  std::string termination;  ///< code of the stop rule that ended the search, e.g. "limit_points", "steps"
  std::string message;      ///< a sentence with the deciding numbers
  /// First local minimum of the stiffness ratio below 0.1 before the critical load, else the lowest minimum,
  /// else the critical point; empty: none.
  std::optional<Softest> softest = {};
  std::optional<AtCritical> at_critical = {};
};

struct MeshReport {
  int elements = -1;
  int order = -1;
  int unknowns = -1;  ///< free displacement unknowns, with element interiors
  int refinements = -1;
  std::optional<double> requested_accuracy;
  std::optional<double> estimated_accuracy;
  /// Number of paths followed, the last one reported. Each repeats the previous one on a mesh at least four
  /// times as fine, because finer meshes did not confirm the result.
  int paths = 1;
  /// Element ends along each member but rods, on the reported path's mesh, as fractions; empty without a
  /// path.
  std::vector<std::vector<double>> ends;
};

struct Diagnostics {
  int steps = -1;
  int rejected_steps = -1;
  int iterations = -1;
  int factorizations = -1;
  double max_relative_residual = -1.0;
  std::vector<std::string> skipped;      ///< parts of the model and work that were omitted
  std::array<int, 32> corrections = {};  ///< entry i: steps with i Newton corrections, 31 for more
};

/// Stress-free offsets at fractions of a member, as in PointsImperfection.
struct MemberOffsets {
  std::string member;
  std::vector<std::array<double, 2>> offsets;
};

/// Worst imperfection that was found, with the critical loads of the search for it.
struct WorstOffset {
  double perfect_load_factor = 0.0;  ///< critical load factor without it
  CriticalType perfect_type = CriticalType::limit_max;
  /// Critical load factor by the first-order law of limit points; empty where the law does not apply.
  std::optional<double> first_order_load_factor;
  std::optional<double> load_factor;         ///< critical load factor with it; empty: no stability is lost
  int paths = -1;                            ///< paths that the search followed
  std::vector<MemberOffsets> imperfections;  ///< one per member
};

/// Numerical failure. The rest of the result holds what was reached.
struct Failure {
  std::string code;  ///< "no_convergence", "step_underflow", "cancelled", "no_start", "not_held", ...
  std::string detail;
};

struct Result {
  Summary summary;
  std::vector<CriticalPoint> critical_points;
  std::vector<NeutralMotion> neutral_motion;
  std::vector<CapacityLimit> capacity = {};  ///< at most one for each sense of the load factor
  std::vector<ContactEvent> contact_events;
  std::vector<Branch> branches;
  std::vector<State> states;
  std::optional<StaticTable> static_table;
  std::vector<double> not_reached;  ///< requested load factors
  std::optional<BucklingResult> buckling;
  std::optional<std::vector<Vibration>> vibrations = {};  ///< the analysis `vibration` has them
  std::optional<std::vector<MemberExtremes>> extremes;    ///< if requested; empty: no state was reached
  std::optional<FirstYield> first_yield = {};             ///< empty: no path was followed, or none was met
  std::optional<WorstOffset> worst_imperfection = {};     ///< if the model has a worst imperfection
  std::vector<Warning> warnings;
  MeshReport discretization;
  Diagnostics diagnostics;
  std::optional<Failure> failure;
};

}  // namespace snapthrough
