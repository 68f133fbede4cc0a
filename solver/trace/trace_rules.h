#pragma once
/// @file
/// What ends a path.

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "solver/events/contact_change.h"
#include "solver/events/critical_event.h"
#include "solver/events/flutter.h"
#include "solver/path/path_point.h"

namespace snapthrough {

/// A number along a path and its derivative by arc length.
struct Quantity {
  std::function<double(const PathPoint&)> value;
  std::function<double(const PathPoint&)> rate;
};

/// A number along a path that ends it where it leaves a range.
struct BoundedQuantity {
  std::function<double(const PathPoint&)> value;
  std::array<double, 2> range{};
};

/// Limit loads of supports with a capacity, as small displacements have them (CapacityEnds).
struct CapacityRule {
  /// Share of a limit at which a path ends. The displacements of a hyperbolic law are a thousand times those
  /// of its initial stiffness there, those of other laws less. Source: docs/decisions/0036.
  static constexpr double reached = 0.999;
  /// Value of LocateOptions::before_kink on a path whose supports have a capacity.
  static constexpr double kink = 1e-3;
  std::array<double, 2> limits{};  ///< least and largest load factor that the supports hold; infinite: any
  /// Range of the load factor that ends the path: the rest up to a limit takes displacements that grow
  /// without bound.
  std::array<double, 2> range{};
  /// Whether the motion that loses its stiffness at a critical point moves each member as a whole.
  std::function<bool(const CriticalEvent&)> moves_rigidly;

  /// Whether a path that cannot go on at a load factor has met the capacity of its supports.
  [[nodiscard]] bool is_near(double lambda) const { return is_within(near, lambda); }
  /// Whether a load factor is so near a limit that a critical point there is the capacity, also where its
  /// softest motion bends members.
  [[nodiscard]] bool is_at(double lambda) const { return is_within(reached, lambda); }

 private:
  /// Share of a limit from which on a path that cannot go on has met it. Geometry, or the finite
  /// displacements at which laws approach their capacity, take the rest; chosen.
  static constexpr double near = 0.9;
  [[nodiscard]] bool is_within(double share, double lambda) const {
    return lambda < 0.0 ? lambda <= share * limits[0] : lambda >= share * limits[1];
  }
};

/// A load factor at which the state of a path is wanted.
struct AskedLoad {
  std::size_t row = 0;  ///< number of the caller for the state
  double load = 0.0;    ///< scaled load factor
};

/// Load factors at which the states of a path are wanted.
struct AskedStates {
  std::vector<AskedLoad> loads;
  bool once = false;  ///< the first state at each load alone; else each one that the path passes
};

/// Stop rules in the path's own units (scaled load factors, scaled unknowns); empty rules do not stop.
struct TraceRules {
  bool first_loss_of_stability = false;
  std::optional<int> limit_points;            ///< number of limit points, the last of which ends the path
  std::optional<std::array<double, 2>> load;  ///< range of the load factor
  std::optional<CapacityRule> capacity;       ///< empty: supports hold any load
  std::optional<BoundedQuantity> monitor;
  std::optional<Quantity> controlled;  ///< ends the path where it turns back (displacement control)
  int steps = 1000;
  AskedStates asked;            ///< a step over one of these loads is taken only where its state is found
  bool grows_at_start = false;  ///< vibrations about the first point grow and oscillate (flutter)
  ZoneCounter zones;            ///< empty: contact that begins or ends is not looked for
  double gradient = 4.0;        ///< norm of the displacement (rms gradient) at which a path is given up
  double travel = 1000.0;       ///< that bound for the sum of all steps' displacements: members that wind up
  /// Whether the beam theory no longer holds at a point, where a path is given up as well; empty: it holds.
  std::function<bool(const PathPoint&)> beyond_theory;
  /// A point with more negative eigenvalues ends the path, as a rule the critical point that leads there;
  /// empty: no number of them does.
  std::optional<int> most_negative;
  /// Whether `most_negative` does not hold at a point; empty: it holds everywhere.
  std::function<bool(const PathPoint&)> most_negative_waits;
  std::optional<double> first_step;  ///< in the path's norm; empty: from the load's scale
  /// Critical points of other branches: the path ends where it meets one of them again.
  std::vector<PathPoint> known;
  /// Load factors of critical points on another mesh, which the path approaches by short steps.
  std::vector<double> expected;
  LocateOptions locate;
  /// Imperfection of a bifurcation on a finer mesh, to tell one that the mesh makes from a real one; none
  /// where that mesh does not have the bifurcation. Empty: there is no finer mesh.
  std::function<std::optional<double>(const CriticalEvent&)> finer_imperfection;
  /// What following loads do on a step between two points; empty: every load has a potential.
  std::function<StepVibrations(const PathPoint& from, const PathPoint& to)> vibrations;
  /// Largest imperfection of a bifurcation that the path passes by and that is reported.
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
  capacity,
  cancelled,
  step_underflow,
  no_start
};

}  // namespace snapthrough
