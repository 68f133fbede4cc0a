#pragma once
/// @file
/// Turns what a path follower reports into the result document's branches, critical points and states.

#include <vector>

#include "solver/path/trace.h"
#include "solver/solve.h"

namespace snapthrough {

struct Structure;

/// Collects the path, the critical points and the states that were asked for.
class Recorder {
 public:
  Recorder(const Model& model, const Analysis& analysis, const Structure& structure,
           Continuation& continuation, Result& result)
      : model_(model),
        analysis_(analysis),
        structure_(structure),
        continuation_(continuation),
        result_(result) {}

  [[nodiscard]] TraceSink sink(const Hooks& hooks);

 private:
  void start_branch();
  void add_point(const PathPoint& point);
  void add_critical(const CriticalEvent& event);
  void add_states_at_loads(const PathPoint& from, const PathPoint& to);
  int add_state(const PathPoint& point);
  [[nodiscard]] std::vector<NamedValue> monitors(const PathPoint& point) const;
  [[nodiscard]] double user_load(const PathPoint& point) const;

  const Model& model_;
  const Analysis& analysis_;
  const Structure& structure_;
  Continuation& continuation_;
  Result& result_;
  int points_ = 0;
};

}  // namespace snapthrough
