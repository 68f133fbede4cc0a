#pragma once
/// @file
/// Copies a store to another store of any driver.

#include <cstdint>
#include <functional>

#include "server/store/store.h"

namespace snapthrough::server {

/// Progress of a copy.
struct CopyCounts {
  std::int64_t jobs = 0;    ///< jobs copied
  std::int64_t sweeps = 0;  ///< sweeps copied
  std::int64_t there = 0;   ///< jobs and sweeps that the target had already
  std::int64_t all = 0;     ///< jobs and sweeps of the source
};

/// @brief Copies jobs and sweeps with their documents, results, paths and rows, in the order of arrival. An
/// entry that the target has already stays, so a copy that was cut short can be run again.
///
/// Not copied: claims and crashes of items of sweeps, callbacks of ended work, keys by which rows of sweeps
/// are reused. Unfinished jobs are accepted in the target; an unfinished
/// sweep keeps its rows and goes on. Memory: one job, or rows of some thousand points.
/// @param to REQUIRES: goes by the time of its caller; used by nobody else
/// @param tell called now and then with the progress
Status copy_store(Store& from, Store& to, CopyCounts& counts,
                  const std::function<void(const CopyCounts&)>& tell);

}  // namespace snapthrough::server
