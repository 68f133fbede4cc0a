#pragma once
/// @file
/// The parts of a result document that figures draw, read and checked.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/plot/document.h"
#include "api/plot/marks.h"
#include "api/plot/numbers.h"

namespace snapthrough::api::plot {

using Monitors = std::map<std::string, std::vector<double>>;

/// Rates along a branch by arc length, one a row.
struct Rates {
  std::vector<double> load_factor;
  Monitors monitors;
};

/// Rows of a branch of a path, or of a static analysis; lists of equal length but for `computed`.
struct Branch {
  std::vector<double> load_factor;
  std::vector<double> arc_length;  ///< arc length of the path; static analysis: row's index
  Monitors monitors;
  std::vector<double> negative_eigenvalues;  ///< number at each row; kNone: not counted
  std::vector<std::size_t> computed;         ///< rows at which an equilibrium was solved
  std::optional<Rates> rates;                ///< nullopt: straight lines between the rows
};

struct CriticalPoint {
  std::size_t branch = 0;
  Mark mark = Mark::limit_max;
  double load_factor = 0;
  double arc_length = 0;
  bool confirmed = true;
  std::map<std::string, double> monitors;
  std::optional<std::size_t> state;
};

/// Point of the primary path at which the structure is nearly unstable before its first critical point.
struct Softest {
  double load_factor = 0;
  double ratio = 0;  ///< least stiffness there over that of the unloaded structure, more than 0
};

/// First state of the primary path in which an outer fibre reaches its strength.
struct FirstYield {
  double load_factor = 0;
  double arc_length = 0;
};

struct ContactEvent {
  std::size_t branch = 0;
  Mark mark = Mark::closed;
  double load_factor = 0;
  double arc_length = 0;
};

/// Smallest and largest value along a member, by the place.
struct PeakRange {
  std::pair<double, double> min, max;  ///< arc length, value
};

/// State of a member along its axis; lists of equal length, at least two.
struct MemberState {
  std::vector<double> s, x0, y0, x, y, u, v, axial_force, shear_force, bending_moment;
  /// Extremes of N, Q and M by their names in the document; empty in results of earlier versions.
  std::map<std::string, PeakRange> extremes;
};

/// Adds the extremes of a quantity to a list of its values where the list has no such place.
void add_peaks(const PeakRange& peaks, std::vector<double>& s, std::vector<double>& values);

struct Force {
  double fx = 0;
  double fy = 0;
  double moment = 0;
};

struct FoundationState {
  std::vector<double> s, reaction, displacement;
  std::vector<std::pair<double, double>> contact;  ///< intervals of s in contact
  Force resultant;
};

struct SpringState {
  bool closed = true;
};

struct State {
  double load_factor = 0;
  std::map<std::string, MemberState> members;
  std::map<std::string, Force> supports;  ///< support forces by node id
  std::map<std::string, FoundationState> foundations;
  std::map<std::string, SpringState> springs;
};

/// Displacements of a mode along a member; lists of equal length, at least two.
struct ModeShape {
  std::vector<double> s, u, v;
};
using Mode = std::map<std::string, ModeShape>;

/// Returns the branches of a path, or the rows of a static analysis as one branch.
[[nodiscard]] std::vector<Branch> read_branches(const Field& result);
/// Returns critical points in the order of the document.
[[nodiscard]] std::vector<CriticalPoint> read_critical_points(const Field& result);
/// Returns the softest point; nullopt where the stiffness has no minimum before it is zero, or without a
/// path.
[[nodiscard]] std::optional<Softest> read_softest(const Field& result);
/// Returns the first yield of the primary path; nullopt where it has none.
[[nodiscard]] std::optional<FirstYield> read_first_yield(const Field& result);
[[nodiscard]] std::vector<ContactEvent> read_contact_events(const Field& result);
/// Returns one state. @throws PlotError when the result has no state of that index
[[nodiscard]] State read_state(const Field& result, std::size_t index);
/// Returns `asked`, or the state of the first critical point with a state, or the last state.
[[nodiscard]] std::size_t chosen_state(const Field& result, const std::optional<std::size_t>& asked);
[[nodiscard]] Mode read_mode(const Field& mode);
[[nodiscard]] Units read_units(const Field& result);
/// Returns the unit labels of a model.
[[nodiscard]] Units read_model_units(const Field& model);
[[nodiscard]] std::string read_title(const Field& result);

/// Sorts ids with numbers in numerical order: "m2" before "m10".
[[nodiscard]] std::vector<std::string> naturally_sorted(std::vector<std::string> ids);

}  // namespace snapthrough::api::plot
