#pragma once
/// @file
/// Request for an analysis. Plain data, one field for each field of the request's `analysis`.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/model/model.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {

enum class AnalysisType {
  buckling,   ///< linearised buckling loads
  critical,   ///< the first critical load on the equilibrium path
  path,       ///< the equilibrium path
  static_,    ///< equilibria at given load factors
  vibration,  ///< natural frequencies at given load factors
};

/// @brief What a kind of analysis takes and gives, one row per kind in traits_of().
///
/// Code that differs between kinds asks these, so that a new kind is complete with its row, its runner in
/// solve() and its name in api/names.h; the compiler refuses the first two where they are missing.
struct AnalysisTraits {
  /// Loads of an eigenvalue problem about the reference load, with small displacements; no states.
  bool linearised = false;
  /// Has a row for each of Analysis::load_factors.
  bool has_rows = false;
  /// Follows the equilibrium path and locates critical points on it.
  bool follows_path = false;
  /// The path is in the result: points, branches, changes of contact; it obeys `step`, `stop` and `start`.
  bool reports_path = false;
  /// Natural frequencies are the result.
  bool vibrates = false;

  /// Whether the path ends where stability is lost first, and is no part of the result.
  [[nodiscard]] constexpr bool ends_at_loss() const { return follows_path && !reports_path; }
};

[[nodiscard]] constexpr AnalysisTraits traits_of(AnalysisType type) {
  switch (type) {
    case AnalysisType::buckling:
      return {.linearised = true};
    case AnalysisType::critical:
      return {.follows_path = true};
    case AnalysisType::path:
      return {.follows_path = true, .reports_path = true};
    case AnalysisType::static_:
      return {.has_rows = true};
    case AnalysisType::vibration:
      return {.has_rows = true, .vibrates = true};
  }
  return {};
}

enum class Geometry { nonlinear, linear };
enum class FoundationRule { consistent, lumped };
enum class ControlType { arc_length, load, displacement };
enum class Follow { primary, first, all };
/// Action of a static analysis whose path loses stability before a requested load factor.
enum class Unstable { refuse, follow };
enum class StateOutput { none, critical, all, every, at_load_factors };

/// Mesh control: by accuracy (the solver chooses the mesh) or by a fixed mesh.
struct Discretization {
  double accuracy = 1e-3;   ///< wanted relative error of each reported load factor, in (0, 0.5]
  bool fixed_mesh = false;  ///< true: the fields below apply
  int elements = 0;         ///< elements per member that is not in `member_elements`; 0: not given
  std::vector<std::pair<std::string, int>> member_elements;  ///< numbers of elements by member id
  int order = 1;  ///< polynomial order of the elements, 1 to kMaxOrder
  FoundationRule foundation = FoundationRule::consistent;
  bool full_stiffness = false;  ///< set by as_stiff_as_given()
};

struct Control {
  ControlType type = ControlType::arc_length;
  std::string monitor;  ///< id of the monitor, for displacement control
};

/// Step lengths as fractions of the scale of the first critical load; empty: chosen by the solver.
struct StepOptions {
  std::optional<double> initial;
  std::optional<double> min;
  std::optional<double> max;
  double direction = 1.0;  ///< initial sense of the load factor: 1 growing, -1 falling
};

struct MonitorRange {
  std::string id;
  std::array<double, 2> range{0.0, 0.0};
};

/// Stop rules of a path; the first that is met ends it. Empty rules are inactive.
struct StopRules {
  std::optional<int> limit_points;
  std::optional<std::array<double, 2>> load_factor;
  std::optional<MonitorRange> monitor;
  std::optional<int> steps;
  /// Number of negative eigenvalues above which the path ends; empty: limit of the solver.
  std::optional<int> negative_eigenvalues;
};

struct BranchOptions {
  Follow follow = Follow::primary;
  std::optional<int> limit;
};

struct OutputOptions {
  StateOutput states = StateOutput::critical;
  int every = 1;
  std::vector<double> at_load_factors;
  int points_per_member = 101;  ///< sampled points per member, >= 2
  /// Least number of points on each branch, evenly spaced along its arc; empty: accepted steps only.
  std::optional<int> path_points;
  bool extremes = false;  ///< reports extreme section forces and displacements of each member
  bool modes = true;      ///< reports modes with the states of critical points
  std::vector<Location> stiffness_at = {};  ///< places whose tangent stiffness the states report
  int frequencies = 0;  ///< number of natural frequencies at the points of a path and of static states
};

/// Number of the model with respect to which critical loads are differentiated.
struct Variation {
  std::string pointer;  ///< name in the result
  double value = 0.0;   ///< value in the given model
  double size = 1.0;    ///< magnitude of a large change, > 0, in the unit of the value
  /// Model with another value; empty when that value is not allowed. Called from the solving thread with
  /// values within `size` of `value`.
  std::function<std::optional<Model>(double)> model_at;
};

/// Displacements and section forces at positions along a member, as in reported states.
struct MemberShape {
  std::string id;
  std::vector<double> s;                   ///< arc length of the perfect axis, from 0 to its length
  std::vector<double> u, v, rotation;      ///< displacements along x and y, rotation in rad
  std::vector<double> axial, shear, bend;  ///< section forces N, Q, M
};

/// Initial state of a path; corrected to an equilibrium at its load factor.
struct StartState {
  double load_factor = 0.0;
  std::vector<MemberShape> members;
};

struct Analysis {
  AnalysisType type = AnalysisType::critical;
  int modes = 1;          ///< `buckling`: number of loads; `vibration`: number of frequencies
  bool reversed = false;  ///< `buckling`: also loads of the opposite sense, as negative load factors
  std::vector<double> load_factors{1.0};
  Unstable unstable = Unstable::refuse;
  Geometry geometry = Geometry::nonlinear;
  Discretization discretization;
  Control control;
  StepOptions step;
  std::optional<StartState> start;  ///< `path`; empty: the unloaded state, or that under the constant actions
  StopRules stop;
  BranchOptions branches;
  OutputOptions output;
  std::vector<Variation> sensitivities;  ///< for the critical points of a path
  bool koiter = false;                   ///< Koiter coefficients of the bifurcations of a path

  [[nodiscard]] constexpr AnalysisTraits traits() const { return traits_of(type); }
};

}  // namespace snapthrough
