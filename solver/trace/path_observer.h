#pragma once
/// @file
/// Receives what is found along a path.

#include <cstddef>
#include <vector>

#include "solver/events/contact_change.h"
#include "solver/events/critical_event.h"
#include "solver/path/path_point.h"

namespace snapthrough {

/// @brief Receives the points and the events of a path in the order in which the path meets them. On a step
/// the events come first, then the step, then its end.
class PathObserver {
 public:
  PathObserver() = default;
  PathObserver(const PathObserver&) = delete;
  PathObserver& operator=(const PathObserver&) = delete;
  PathObserver(PathObserver&&) = delete;
  PathObserver& operator=(PathObserver&&) = delete;
  virtual ~PathObserver() = default;

  /// The start, the end of every accepted step, and the end of the path.
  virtual void on_point(const PathPoint&) {}
  virtual void on_critical(const CriticalEvent&) {}
  virtual void on_contact(const ContactChange&) {}
  /// A place where stability cannot be decided, see LocatedEvents::touching.
  virtual void on_touching(const PathPoint&) {}
  /// The last point once more, with fewer pinned motions.
  virtual void on_unpinned(const PathPoint&) {}
  /// @brief The state at a load of TraceRules::asked on the step that on_step() tells next.
  /// @param row AskedLoad::row of that load
  virtual void on_asked(std::size_t /*row*/, const PathPoint& /*state*/) {}
  /// An accepted step: all points of the path between its ends are on one Segment.
  virtual void on_step(const PathPoint& /*from*/, const PathPoint& /*to*/) {}
};

/// Observers in the order in which they are told; not owned.
using PathObservers = std::vector<PathObserver*>;

}  // namespace snapthrough
