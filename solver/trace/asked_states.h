#pragma once
/// @file
/// States of a path at the load factors that are asked for.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "solver/path/point_solver.h"
#include "solver/trace/trace_rules.h"

namespace snapthrough {

/// @brief Finds the states at asked load factors step by step.
///
/// A state belongs to the step on which the path passes its load, and to the step that ends there; a step
/// that passes a limit point may have two. The first step of a path also has the state at its start.
class AskedStateSearch {
 public:
  /// Receives AskedLoad::row of a load and the state there.
  using Receiver = std::function<void(std::size_t row, const PathPoint& state)>;

  /// @param solver, asked kept by reference
  AskedStateSearch(PointSolver& solver, const AskedStates& asked)
      : solver_(solver), asked_(asked), told_(asked.loads.size(), 0) {}

  /// @brief Looks for the states on a step whose end may still change.
  /// @param turns limit points between `from` and `to`, in the order of the path
  /// @return false when one of them is not found, so that a shorter step is needed
  [[nodiscard]] bool look_on(const PathPoint& from, const std::vector<PathPoint>& turns, const PathPoint& to);
  /// @brief Tells the states on an accepted step, between its limit points in the order of the loads. A state
  /// that is not found is not told.
  void tell(const PathPoint& from, const std::vector<PathPoint>& turns, const PathPoint& to,
            const Receiver& receive);

 private:
  /// A state between the ends of a step.
  struct Found {
    std::size_t piece = 0;  ///< number of limit points before it on the step
    std::size_t index = 0;  ///< index of its load
    PathPoint state;
  };
  [[nodiscard]] bool look_on_piece(std::size_t piece, const PathPoint& from, const PathPoint& to);
  void tell_piece(std::size_t piece, const PathPoint& from, const PathPoint& to, const Receiver& receive);
  /// The state at a load on a piece; empty when the piece does not have it, or it is not found.
  [[nodiscard]] std::optional<PathPoint> state_on(std::size_t piece, std::size_t index, const PathPoint& from,
                                                  const PathPoint& to);
  [[nodiscard]] bool passes(std::size_t index, const PathPoint& from, const PathPoint& to) const;

  PointSolver& solver_;
  const AskedStates& asked_;
  std::vector<char> told_;
  std::vector<Found> found_;  ///< by look_on()
  bool at_start_ = true;      ///< no step was accepted
};

}  // namespace snapthrough
