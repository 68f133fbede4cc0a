#pragma once
/// @file
/// The branches of a path.

#include <string>
#include <vector>

#include "solver/accuracy/critical_loads.h"
#include "solver/analysis/monitor_watch.h"
#include "solver/analysis/recorder.h"
#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/hooks.h"
#include "solver/model/analysis.h"
#include "solver/path/path_follower.h"
#include "solver/trace/trace.h"

namespace snapthrough {

/// Follows branches of the primary path, and branches of those, within the request's limits.
class BranchFollower {
 public:
  /// All arguments are kept by reference, and must outlive this object.
  BranchFollower(const Analysis& analysis, const Structure& structure, PathFollower& follower,
                 Recorder& recorder, CriticalLoads& loads, MonitorWatch& watch, const Hooks& hooks);

  /// Adds the bifurcations of a path whose branches are to be followed. @param branch index of the path
  void add(const TraceOutcome& outcome, int branch);
  /// @return sentence on the branches that were followed and omitted
  [[nodiscard]] std::string run();

 private:
  /// Bifurcation with one direction along its branch that remains to be followed.
  struct Pending {
    CriticalEvent at;
    int parent = 0;
    double sign = 1.0;
  };
  [[nodiscard]] bool follow(const Pending& pending);

  const Analysis& analysis_;
  TraceRules rules_;
  PathFollower& follower_;
  Recorder& recorder_;
  CriticalLoads& loads_;
  MonitorWatch& watch_;
  const Hooks& hooks_;
  int limit_ = 0;
  int branches_ = 0;
  int lost_ = 0;
  int rejoined_ = 0;
  std::vector<Pending> pending_;
};

}  // namespace snapthrough
