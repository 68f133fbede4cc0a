#pragma once
/// @file
/// Runs of units of a sweep, for drivers of stores.

#include <cstdint>
#include <vector>

#include "server/sweeps/sweep.h"

namespace snapthrough::server {

/// Adds a unit to runs in order. @pre it comes after all of them
inline void add_unit(std::vector<UnitRun>& runs, std::uint64_t unit) {
  if (!runs.empty() && runs.back().first + runs.back().count == unit) {
    ++runs.back().count;
  } else {
    runs.push_back({unit, 1});
  }
}

/// The units that are not done, in order. @param done by unit, from `first` on
inline std::vector<UnitRun> runs_without(std::uint64_t first, const std::vector<bool>& done) {
  std::vector<UnitRun> runs;
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (!done[i]) {
      add_unit(runs, first + i);
    }
  }
  return runs;
}

}  // namespace snapthrough::server
