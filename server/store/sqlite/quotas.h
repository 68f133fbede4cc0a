#pragma once
/// @file
/// What an owner has, held against what it may have.

#include <string_view>

#include "server/store/quota_check.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// Counts what an owner hands in, or says as check_quotas() of server/store/quota_check.h why it may not.
[[nodiscard]] Status admit(Connection& connection, std::string_view owner, const Quotas& quotas,
                           const Usage& addition, Time now);

}  // namespace snapthrough::server::sqlite
