#pragma once
/// @file
/// States of a path at the load factors that are asked for.

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "solver/path/point_solver.h"
#include "solver/trace/trace_rules.h"

namespace snapthrough {

/// @brief Finds the states at asked load factors step by step.
///
/// A state belongs to the step on which the path passes its load, and to the step that ends there. The first
/// step of a path also has the state at its start.
class AskedStateSearch {
 public:
  /// Receives AskedLoad::row of a load and the state there.
  using Receiver = std::function<void(std::size_t row, const PathPoint& state)>;

  /// @param solver, asked kept by reference
  AskedStateSearch(PointSolver& solver, const AskedStates& asked)
      : solver_(solver), asked_(asked), told_(asked.loads.size(), 0) {}

  /// @brief Looks for the states on a step whose end may still change.
  /// @return false when one of them is not found, so that a shorter step is needed
  [[nodiscard]] bool look_on(const PathPoint& from, const PathPoint& to);
  /// @brief Tells the states on an accepted step, in the order of the loads. A state that is not found is not
  /// told.
  void tell(const PathPoint& from, const PathPoint& to, const Receiver& receive);

 private:
  /// The state at a load on a step; empty when the step does not have it, or it is not found.
  [[nodiscard]] std::optional<PathPoint> state_on(std::size_t index, const PathPoint& from,
                                                  const PathPoint& to);
  [[nodiscard]] bool passes(std::size_t index, const PathPoint& from, const PathPoint& to) const;

  PointSolver& solver_;
  const AskedStates& asked_;
  std::vector<char> told_;
  std::vector<std::pair<std::size_t, PathPoint>> found_;  ///< by look_on(), between the ends of the step
  bool at_start_ = true;                                  ///< no step was accepted
};

}  // namespace snapthrough
