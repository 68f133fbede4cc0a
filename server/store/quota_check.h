#pragma once
/// @file
/// What an owner has, held against what it may have.

#include <cstdint>

#include "server/environment.h"
#include "server/jobs/quotas.h"
#include "server/status.h"

namespace snapthrough::server {

/// What an owner has, or what is to be added to it.
struct Usage {
  std::int64_t jobs = 0;
  std::int64_t points = 0;
  std::int64_t bytes = 0;
  std::int64_t points_this_hour = 0;  ///< the last sixty minutes
};

/// `waiting_quota`, `storage_quota` or `rate_quota`, with the name of the quota, when the owner would have
/// more than it may.
[[nodiscard]] Status check_quotas(const Quotas& quotas, const Usage& has, const Usage& more);

}  // namespace snapthrough::server
