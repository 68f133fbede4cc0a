#pragma once
/// @file
/// What is to be computed for a model. Plain data, one field for each field of the request's `analysis`.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/model/model.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {

enum class AnalysisType { buckling, critical, path, static_ };
enum class Geometry { nonlinear, linear };
enum class FoundationRule { consistent, lumped };
enum class ControlType { arc_length, load, displacement };
enum class Follow { primary, first, all };
/// What a static analysis does where its path loses stability before a load factor that was asked for.
enum class Unstable { refuse, follow };
enum class StateOutput { none, critical, all, every, at_load_factors };

/// Either an accuracy (the mesh is the solver's business) or a fixed mesh.
struct Discretization {
  double accuracy = 1e-3;   ///< relative error wanted in each reported load factor, in (0, 0.5]
  bool fixed_mesh = false;  ///< true: the fields below hold
  int elements = 0;         ///< elements on each member not named in `member_elements`; 0: none given
  std::vector<std::pair<std::string, int>> member_elements;  ///< by member id
  int order = 1;  ///< polynomial order of the elements, 1 to kMaxOrder
  FoundationRule foundation = FoundationRule::consistent;
};

struct Control {
  ControlType type = ControlType::arc_length;
  std::string monitor;  ///< with displacement control
};

/// Step lengths as fractions of the scale of the first critical load; empty: the solver's own.
struct StepOptions {
  std::optional<double> initial;
  std::optional<double> min;
  std::optional<double> max;
  double direction = 1.0;  ///< of the load factor where the path begins: 1 growing, -1 falling
};

struct MonitorRange {
  std::string id;
  std::array<double, 2> range{0.0, 0.0};
};

/// Stop rules of a path: the first to be met ends it. Empty rules do not stop.
struct StopRules {
  std::optional<int> limit_points;
  std::optional<std::array<double, 2>> load_factor;
  std::optional<MonitorRange> monitor;
  std::optional<int> steps;
  /// A point with more negative eigenvalues ends the path; empty: the solver's own bound.
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
  int points_per_member = 101;  ///< >= 2
  /// At least so many points on each branch of a path, evenly along its arc; empty: its own steps'.
  std::optional<int> path_points;
  bool extremes = false;  ///< extreme section forces and displacements of each member
  bool modes = true;      ///< modes with the states of critical points
};

/// A number of the model that critical loads are differentiated by.
struct Variation {
  std::string pointer;  ///< what it is called in the result
  double value = 0.0;   ///< of the model at hand
  double size = 1.0;    ///< a change of this size is a large one; > 0, in the unit of the value
  /// The model with another value; empty where it may not have that value. Called from the solving thread,
  /// with values within `size` of the model's.
  std::function<std::optional<Model>(double)> model_at;
};

/// Displacements and section forces at places along a member, as a state of a result lists them.
struct MemberShape {
  std::string id;
  std::vector<double> s;                   ///< arc length of the perfect axis, from 0 to its length
  std::vector<double> u, v, rotation;      ///< displacements along x and y, rotation in rad
  std::vector<double> axial, shear, bend;  ///< section forces N, Q, M
};

/// The state that a path begins with; it is corrected to an equilibrium at its load factor.
struct StartState {
  double load_factor = 0.0;
  std::vector<MemberShape> members;
};

struct Analysis {
  AnalysisType type = AnalysisType::critical;
  int modes = 1;
  bool reversed = false;  ///< `buckling`: loads of the opposite sense count, too, as negative load factors
  std::vector<double> load_factors{1.0};
  Unstable unstable = Unstable::refuse;
  Geometry geometry = Geometry::nonlinear;
  Discretization discretization;
  Control control;
  StepOptions step;
  std::optional<StartState> start;  ///< `path`; empty: the unloaded state, or that of the constant actions
  StopRules stop;
  BranchOptions branches;
  OutputOptions output;
  std::vector<Variation> sensitivities;  ///< of the critical points of a path
  bool koiter = false;                   ///< Koiter's coefficients of the bifurcations of a path
};

}  // namespace snapthrough
