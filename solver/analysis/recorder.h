#pragma once
/// @file
/// Writes points and events of traced paths into the result: branches, critical points and states.

#include <optional>
#include <string>
#include <vector>

#include "solver/accuracy/static_states.h"
#include "solver/analysis/first_yield.h"
#include "solver/analysis/frequency_probe.h"
#include "solver/analysis/observer.h"
#include "solver/analysis/path_points.h"
#include "solver/analysis/softest_point.h"
#include "solver/hooks.h"
#include "solver/report/contact.h"
#include "solver/report/neutral_motion.h"
#include "solver/report/state.h"
#include "solver/report/support_state.h"
#include "solver/trace/path_observer.h"
#include "solver/trace/trace_rules.h"

namespace snapthrough {

struct Structure;

/// Records the path, its critical points and the requested states.
class Recorder final : public PathObserver {
 public:
  Recorder(const Analysis& analysis, const Structure& structure, PointSolver& solver, SoftestPoint& softest,
           const Hooks& hooks, Result& result)
      : model_(*structure.model),
        analysis_(analysis),
        structure_(structure),
        solver_(solver),
        softest_(softest),
        hooks_(hooks),
        result_(result),
        zones_(structure),
        neutral_(structure, result.neutral_motion),
        observer_(analysis, structure),
        yield_(structure, solver),
        reached_(analysis.output.at_load_factors.size(), 0) {
    if (analysis.output.frequencies > 0 && analysis.traits().reports_path)
      probe_.emplace(structure, analysis);
  }

  /// What a path reports is recorded under `branch` from now on. To be called before each path.
  void begin_branch(int branch = 0, std::optional<int> parent = std::nullopt);

  void on_point(const PathPoint& point) override;
  void on_critical(const CriticalEvent& event) override;
  void on_contact(const ContactChange& change) override;
  void on_touching(const PathPoint& point) override;
  void on_unpinned(const PathPoint& point) override;
  void on_asked(std::size_t row, const PathPoint& state) override;
  void on_step(const PathPoint& from, const PathPoint& to) override;

  /// Counts what on_contact() reports; empty when no support is one-sided.
  [[nodiscard]] ZoneCounter zone_counter() const;
  /// Sets what the recorder wants to be told of: states at load factors, and changes of contact.
  void ask(TraceRules& rules) const;
  /// Completes the last branch and sets its termination code.
  void end_branch(const char* code);
  /// Records a point that trace() does not report.
  void add_point(const PathPoint& point);
  /// Writes extremes and warnings of all branches, after their states are final.
  /// @param last no other mesh follows: the states at asked load factors are refined to the accuracy
  void finish(bool last);

 private:
  void add_row(const PathRow& row);
  void add_rows(bool last);
  void warn_of_rows(int missing);
  void add_critical(const CriticalEvent& event);
  /// Adds a state to the result.
  /// @param most imbalance() of an equilibrium
  /// @return its index; empty for a state that is no equilibrium
  std::optional<int> add_state(const PathPoint& point, double most = StateLimits::imbalance);
  [[nodiscard]] double user_load(const PathPoint& point) const;

  const ResolvedModel& model_;
  const Analysis& analysis_;
  const Structure& structure_;
  PointSolver& solver_;
  SoftestPoint& softest_;
  const Hooks& hooks_;
  Result& result_;
  ContactZones zones_;
  NeutralMotionLog neutral_;
  std::optional<FrequencyProbe> probe_;  ///< empty: no frequencies are requested
  Observer observer_;
  FirstYieldSearch yield_;                 ///< on the primary path
  std::string refused_;                    ///< sentences on states that are no equilibrium
  std::vector<StaticState> asked_states_;  ///< at asked load factors; rows: indices in the result
  std::vector<char> reached_;              ///< requested load factors whose states were recorded
  PathPoints kept_;                        ///< current branch of a path
  int missing_rows_ = 0;                   ///< missing points of that branch, see PathPoints
  int points_ = 0;
  int branch_ = 0;
  int branch_points_ = 0;  ///< reported on the current branch
  /// Arc length at which stability was lost; the stiffness ratio is zero there by definition.
  std::optional<double> lost_;
};

}  // namespace snapthrough
