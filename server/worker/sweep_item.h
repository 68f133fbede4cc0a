#pragma once
/// @file
/// Items of a sweep: points that are computed, stored and reused together.

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "api/point_outcome.h"
#include "api/sweep.h"
#include "server/worker/runner.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {

/// @brief One point, one followed curve (all points along the parameter that is followed), or one refined
/// curve or surface, which has a single outcome. Thread-safe. REQUIRES: the sweep outlives the item.
class SweepItem {
 public:
  /// @param number counted from 0 @pre number < sweep.items()
  SweepItem(const api::Sweep& sweep, std::uint64_t number) : sweep_(sweep), number_(number) {}

  /// Number of the item's first point; the other points follow it.
  [[nodiscard]] std::uint64_t first() const { return number_ * count(); }
  [[nodiscard]] std::uint64_t count() const { return sweep_.item_size(); }

  /// @brief Keys of the item's points (point_key()), in the order of the points. The key of a point of a
  /// curve includes the curve: following gives other last digits than tracing. The key of a refined curve or
  /// surface is that of its first point with its ranges and its tolerance.
  /// @param outputs Sweep::outputs_text()
  /// @param document document of any point of the sweep, overwritten; null: a new one is made
  [[nodiscard]] std::vector<std::string> keys(const std::string& outputs, std::string_view owner,
                                              std::shared_ptr<nlohmann::json>& document) const;

  /// @brief Outcomes of the item's points, in the order of the points (api::item_outcomes()). Thread-safe if
  /// `solve` is.
  /// @param document see keys()
  [[nodiscard]] std::vector<api::PointOutcome> compute(const SolveFunction& solve, const Hooks& hooks,
                                                       std::shared_ptr<nlohmann::json>& document) const;

  /// Sentence for the error of points without outcome after more than `longest`.
  [[nodiscard]] std::string too_long(std::chrono::seconds longest) const;

 private:
  const api::Sweep& sweep_;
  std::uint64_t number_;
};

/// Computes the items of a task one after the other on this thread and tells the outcomes of each. Ends early
/// when `enough` says so or a stop is requested. Returns processor time and factorizations; curves that are
/// followed count none.
WorkUsage compute_items(const ItemTask& task, const SolveFunction& solve);

}  // namespace snapthrough::server
