#pragma once
/// @file
/// How much of the service one owner may take.

#include <cstdint>

namespace snapthrough::server {

/// What one owner may have at most; 0: any amount. Work that would lead beyond it is not stored; what was
/// accepted is computed and stored whatever its size.
struct Quotas {
  std::int64_t jobs_waiting = 0;     ///< accepted jobs
  std::int64_t points_waiting = 0;   ///< points of accepted and running sweeps that have no row yet
  std::int64_t bytes_kept = 0;       ///< of requests, results, sweeps and their rows
  std::int64_t points_per_hour = 0;  ///< of sweeps, handed in or tried again

  [[nodiscard]] bool any() const {
    return jobs_waiting > 0 || points_waiting > 0 || bytes_kept > 0 || points_per_hour > 0;
  }
};

}  // namespace snapthrough::server
