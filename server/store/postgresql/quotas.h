#pragma once
/// @file
/// What an owner has, held against what it may have.

#include <string_view>

#include "server/store/postgresql/connection.h"
#include "server/store/quota_check.h"

namespace snapthrough::server::postgresql {

/// @brief Counts what an owner hands in, or says as check_quotas() of server/store/quota_check.h why it may
/// not. Others who would add to what it has wait until this transaction ends.
/// @param now microseconds; empty: the database's
[[nodiscard]] Status admit(Connection& connection, std::string_view owner, const Quotas& quotas,
                           const Usage& addition, const std::optional<std::int64_t>& now);

}  // namespace snapthrough::server::postgresql
