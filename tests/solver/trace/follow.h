#pragma once
/// @file
/// A path from the start of a problem, and observers made of functions.

#include <functional>

#include "solver/trace/trace.h"

namespace snapthrough::testing {

inline TraceOutcome follow(EquilibriumProblem& problem, const TraceRules& rules,
                           const PathObservers& observers = {}) {
  PathFollower follower(problem);
  return trace(follower, find_start(follower.solver()).point, rules, {}, observers, {});
}

/// Calls a function for each thing that a path reports; empty functions are not called.
class Observed final : public PathObserver {
 public:
  std::function<void(const PathPoint&)> point;
  std::function<void(const PathPoint&)> touching;
  std::function<void(const CriticalEvent&)> critical;
  std::function<void(const PathPoint&, const PathPoint&)> step;

  void on_point(const PathPoint& at) override {
    if (point) point(at);
  }
  void on_touching(const PathPoint& at) override {
    if (touching) touching(at);
  }
  void on_critical(const CriticalEvent& event) override {
    if (critical) critical(event);
  }
  void on_step(const PathPoint& from, const PathPoint& to) override {
    if (step) step(from, to);
  }
};

}  // namespace snapthrough::testing
