#pragma once
/// @file
/// Units of a sweep: what of it is computed, stored and reused as a whole.

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "api/sweep.h"
#include "server/worker/runner.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {

/// @brief A point, or a curve, which is all points along the parameter that is followed. Refers to the sweep,
/// which must outlive it. Thread-safe.
class SweepUnit {
 public:
  /// @pre number < sweep.units(); units are counted from 0
  SweepUnit(const api::Sweep& sweep, std::uint64_t number) : sweep_(sweep), number_(number) {}

  /// Number of its first point; its other points come next.
  [[nodiscard]] std::uint64_t first() const { return number_ * count(); }
  [[nodiscard]] std::uint64_t count() const { return sweep_.unit_size(); }

  /// @brief The keys of its points (point_key()), in their order. Points of a curve are the same only on the
  /// same curve: following gives other last digits than tracing.
  /// @param outputs Sweep::outputs_text()
  /// @param document of a point of the sweep, to be written over; null makes a new one
  [[nodiscard]] std::vector<std::string> keys(const std::string& outputs, std::string_view owner,
                                              std::shared_ptr<nlohmann::json>& document) const;

  /// @brief The outcomes of its points, in their order (api::unit_outcomes()). Thread-safe if `solve` is.
  /// @param document as above
  [[nodiscard]] std::vector<api::PointOutcome> compute(const SolveFunction& solve, const Hooks& hooks,
                                                       std::shared_ptr<nlohmann::json>& document) const;

  /// Why outcomes are missing when it took longer than `longest`: a sentence.
  [[nodiscard]] std::string too_long(std::chrono::seconds longest) const;

 private:
  const api::Sweep& sweep_;
  std::uint64_t number_;
};

/// @brief Computes the units of a task one after the other on this thread, and tells the outcomes of each.
/// Ends early when it is enough, or asked to stop.
void compute_units(const UnitTask& task, const SolveFunction& solve);

}  // namespace snapthrough::server
