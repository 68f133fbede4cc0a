#pragma once
/// @file
/// Copies what one store keeps to another, of whatever drivers.

#include <cstdint>
#include <functional>

#include "server/store/store.h"

namespace snapthrough::server {

/// How far a copy is.
struct CopyCounts {
  std::int64_t jobs = 0;    ///< copied
  std::int64_t sweeps = 0;  ///< copied
  std::int64_t there = 0;   ///< jobs and sweeps that the target had already
  std::int64_t all = 0;     ///< jobs and sweeps of the source
};

/// @brief Copies jobs and sweeps with their documents, results, paths and rows, in the order of arrival. What
/// the target has already, under the same id and as far, is left alone: a copy that was cut short is run
/// again.
///
/// Not copied: attempts and crashes (a job that has ended has one attempt), idempotency keys, callbacks of
/// what has ended, keys by which rows of sweeps are found for reuse. Work that has not ended is accepted in
/// the target; a sweep that has not ended begins again.
/// @param to goes by the time of its caller; nobody else uses it
/// @param tell called now and then
Status copy_store(Store& from, Store& to, CopyCounts& counts,
                  const std::function<void(const CopyCounts&)>& tell);

}  // namespace snapthrough::server
