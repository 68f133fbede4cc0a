#pragma once
/// @file
/// The parts of a result document that figures are made of, read and checked.

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

/// Rows of a branch, or of a static analysis; lists of equal length.
struct Branch {
  std::vector<double> load_factor;
  std::vector<double> arc_length;  ///< of a static analysis: the number of the row
  Monitors monitors;
  std::vector<double> negative_eigenvalues;  ///< kNone: not counted
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

struct ContactEvent {
  std::size_t branch = 0;
  Mark mark = Mark::closed;
  double load_factor = 0;
  double arc_length = 0;
};

/// Lists along a member, of equal length: two places and more.
struct MemberState {
  std::vector<double> s, x0, y0, x, y, u, v, axial_force, shear_force, bending_moment;
};

struct Force {
  double fx = 0;
  double fy = 0;
  double moment = 0;
};

struct FoundationState {
  std::vector<double> s, reaction, displacement;
  std::vector<std::pair<double, double>> contact;  ///< intervals of s
  Force resultant;
};

struct SpringState {
  bool closed = true;
};

struct State {
  double load_factor = 0;
  std::map<std::string, MemberState> members;
  std::map<std::string, Force> supports;  ///< by node
  std::map<std::string, FoundationState> foundations;
  std::map<std::string, SpringState> springs;
};

/// Displacements along a member, of equal length: two places and more.
struct ModeShape {
  std::vector<double> s, u, v;
};
using Mode = std::map<std::string, ModeShape>;

/// Branches of a path, or the rows of a static analysis as one.
[[nodiscard]] std::vector<Branch> read_branches(const Field& result);
/// In the order of the document.
[[nodiscard]] std::vector<CriticalPoint> read_critical_points(const Field& result);
[[nodiscard]] std::vector<ContactEvent> read_contact_events(const Field& result);
/// One state. @throws PlotError when there is no state with that index
[[nodiscard]] State read_state(const Field& result, std::size_t index);
/// The state that is asked for, or that of the first critical point that has one, or the last.
[[nodiscard]] std::size_t chosen_state(const Field& result, const std::optional<std::size_t>& asked);
[[nodiscard]] Mode read_mode(const Field& mode);
[[nodiscard]] Units read_units(const Field& result);
[[nodiscard]] std::string read_title(const Field& result);

/// Ids as people count: "m2" before "m10".
[[nodiscard]] std::vector<std::string> naturally_sorted(std::vector<std::string> ids);

}  // namespace snapthrough::api::plot
