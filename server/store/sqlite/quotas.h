#pragma once
/// @file
/// What an owner has, held against what it may have.

#include <cstdint>
#include <string_view>

#include "server/jobs/quotas.h"
#include "server/status.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// What is to be added to what an owner has.
struct Addition {
  std::int64_t jobs = 0;
  std::int64_t points = 0;
  std::int64_t bytes = 0;
};

/// `waiting_quota` or `storage_quota`, with the name of the quota, when the owner would have more than it
/// may.
[[nodiscard]] Status check_quotas(const Connection& connection, std::string_view owner, const Quotas& quotas,
                                  const Addition& addition);

}  // namespace snapthrough::server::sqlite
