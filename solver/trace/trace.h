#pragma once
/// @file
/// The path from the unloaded state until a stop rule is met.

#include <array>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "solver/events/contact_change.h"
#include "solver/events/locate.h"
#include "solver/model/analysis.h"
#include "solver/path/continuation.h"

namespace snapthrough {

/// Stop rules in the path's own units; empty rules do not stop.
struct TraceRules {
  bool first_loss_of_stability = false;
  std::optional<int> limit_points;
  bool monitor_turns = false;                 ///< ends where the monitor stops growing (displacement control)
  std::optional<std::array<double, 2>> load;  ///< scaled load factor
  std::function<double(const PathPoint&)> monitor;       ///< with monitor_range
  std::function<double(const PathPoint&)> controlled;    ///< the displacement that monitor_turns looks at
  std::function<double(const PathPoint&)> monitor_rate;  ///< of it by arc length
  std::optional<std::array<double, 2>> monitor_range;
  int steps = 1000;
  ZoneCounter zones;       ///< empty: contact that begins or ends is not looked for
  double gradient = 4.0;   ///< norm of the displacement at which a path is given up as leaving for infinity
  double travel = 1000.0;  ///< the same for the length of the way there, which members that wind up make long
  /// Where a path is given up as well; empty: nowhere.
  std::function<bool(const PathPoint&)> beyond_theory;
  /// A point with more negative eigenvalues ends the path, as a rule the critical point that leads there;
  /// empty: no number of them does.
  std::optional<int> most_negative;
  /// Whether `most_negative` does not hold at a point; empty: it holds everywhere.
  std::function<bool(const PathPoint&)> most_negative_waits;
  std::optional<double> first_step;  ///< in the path's norm; empty: from the load's scale
  /// Critical points of other branches: the path ends where it meets one of them again.
  std::vector<PathPoint> known;
  /// Load factors of critical points on another mesh: approached by short steps.
  std::vector<double> expected;
  LocateOptions locate;
  /// Imperfection of a bifurcation on a finer mesh, to tell the mesh's from a real one; none where that mesh
  /// does not have it. Empty: there is no finer mesh.
  std::function<std::optional<double>(const CriticalEvent&)> finer_imperfection;
  /// Largest imperfection of a bifurcation that the path passes by and that is worth telling.
  double most_broken = 1e-3;
};

/// Why a trace ended.
enum class TraceEnd {
  critical_point,
  unstable_at_start,
  limit_points,
  load_factor,
  monitor,
  monitor_turned,
  rejoined,
  steps,
  negative_eigenvalues,
  displacement_bound,
  load_bound,
  cancelled,
  step_underflow,
  no_start
};

/// Receives what is found, in path order. Any of the functions may be empty.
struct TraceSink {
  std::function<void(const PathPoint&)> on_point;  ///< start, every accepted step, and the end
  std::function<void(const CriticalEvent&)> on_critical;
  std::function<void(const ContactChange&)> on_contact;
  std::function<void(const PathPoint&)> on_touching;  ///< see LocatedEvents::touching
  std::function<void(const PathPoint&)>
      on_holds;  ///< the last point once more, less of whose motions are held
  /// All points between and including a step's ends are reachable here through continuation.between.
  std::function<void(const PathPoint&, const PathPoint&)> on_step;
};

struct TraceOutcome {
  TraceEnd end = TraceEnd::no_start;
  PathPoint last;
  std::vector<CriticalEvent> critical;
  bool on_critical =
      false;  ///< `last` is a critical point, the last of `critical` that the path did not pass by
};

/// @brief Follows the path from `start`; the first rule met ends it, exactly at its value.
/// @param start as Continuation::start() or start_at() gave it; empty: the outcome is `no_start`
[[nodiscard]] TraceOutcome trace(Continuation& continuation, const std::optional<PathPoint>& start,
                                 const TraceRules& rules, const StepOptions& steps, const TraceSink& sink,
                                 const std::stop_token& stop);

}  // namespace snapthrough
