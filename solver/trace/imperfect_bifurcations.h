#pragma once
/// @file
/// Bifurcations that an imperfection breaks, so that the path passes them by.

#include <optional>
#include <vector>

#include "solver/path/path_norm.h"
#include "solver/trace/trace_rules.h"

namespace snapthrough {

/// Largest relative difference of the loads of points at one place; the path's norm may hardly see the load.
inline constexpr double kSameLoad = 1e-3;

/// @brief Tells perfect bifurcations from broken ones, keeps steps short beside these, and reports them once
/// the path has passed them.
class ImperfectBifurcations {
 public:
  /// @param rules, norm kept by reference
  ImperfectBifurcations(const TraceRules& rules, const PathNorm& norm) : rules_(rules), norm_(norm) {}

  /// @brief Whether a bifurcation is such that only rounding or the mesh makes the path pass by. A broken one
  /// is remembered.
  /// @param events bifurcations at one place; empty: false
  [[nodiscard]] bool is_perfect(const std::vector<CriticalEvent>& events);

  /// @brief Size of the next step beside the broken bifurcation found last: the path turns away from it
  /// within what the imperfection changes of its load, and a longer step would cross to the path that goes on
  /// where this one turns. Steps are kept as short near load factors where a path on another mesh had its
  /// critical points.
  [[nodiscard]] double limit_step(const PathPoint& from, double wanted) const;

  /// @brief Puts the broken bifurcations that the path has passed before the events of a step; it drops those
  /// that the path meets after all.
  /// @param may_end whether the step may end the path: all are reported then
  void report_passed(const PathPoint& to, bool may_end, std::vector<CriticalEvent>& events);
  /// Broken bifurcations that are not reported yet.
  [[nodiscard]] const std::vector<CriticalEvent>& pending() const { return pending_; }

 private:
  const TraceRules& rules_;
  const PathNorm& norm_;
  std::optional<CriticalEvent> last_;  ///< the broken bifurcation that was found last
  std::vector<CriticalEvent> pending_;
};

}  // namespace snapthrough
