#pragma once
/// @file
/// What an analysis gives back. Plain data, one field for each field of the result document. Counts that were
/// not filled stay at -1, numbers that do not exist are empty optionals.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace snapthrough {

enum class CriticalType { bifurcation, limit_max, limit_min };
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

/// What one mesh said of a critical point.
struct MeshAnswer {
  int elements = -1;
  int order = -1;
  std::optional<double> load_factor;  ///< empty: the point was not found there
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
  bool confirmed = false;  ///< a second, finer mesh has the point within the accuracy that was asked for
  std::vector<MeshAnswer> meshes;  ///< coarsest first
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
  std::vector<NamedSeries> contact_fraction;  ///< foundation id, fraction of its range in contact
  std::string termination = {};               ///< code as in Summary
};

struct MemberState {
  std::string id;
  std::vector<double> s, x, y, rotation, axial_force, shear_force, bending_moment;
};
struct FoundationState {
  std::string id;
  std::vector<double> s, reaction;
  std::vector<std::array<double, 2>> contact;  ///< intervals [s0, s1] in contact, in the member's s
};
struct State {
  int branch = 0;
  double load_factor = 0.0;
  int refinements = 0;  ///< of the path's mesh, to the mesh that this state is in equilibrium on
  std::vector<MemberState> members;
  std::vector<FoundationState> foundations;
};

struct BucklingMode {
  std::vector<MemberState> members;  ///< s, x, y, rotation only: x, y hold displacements
};
struct BucklingResult {
  std::vector<double> load_factors;
  std::vector<BucklingMode> modes;
};

struct Summary {
  std::optional<double> critical_load_factor;
  std::optional<CriticalType> critical_type;
  std::optional<double> error_estimate;
  std::string termination;  ///< code of the stop rule that ended the search, e.g. "limit_points", "steps"
  std::string message;      ///< a sentence with the deciding numbers
};

struct MeshReport {
  int elements = -1;
  int order = -1;
  int unknowns = -1;  ///< free displacement unknowns, element interiors included
  int refinements = -1;
  std::optional<double> requested_accuracy;
  std::optional<double> estimated_accuracy;
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
  std::string code;  ///< "no_convergence", "step_underflow", "cancelled", "no_start", "loose_part", ...
  std::string detail;
};

struct Result {
  Summary summary;
  std::vector<CriticalPoint> critical_points;
  std::vector<NeutralMotion> neutral_motion;
  std::vector<ContactEvent> contact_events;
  std::vector<Branch> branches;
  std::vector<State> states;
  std::optional<BucklingResult> buckling;
  MeshReport discretization;
  Diagnostics diagnostics;
  std::optional<Failure> failure;
};

}  // namespace snapthrough
