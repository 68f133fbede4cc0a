#pragma once
/// @file
/// What an owner has, held against what it may have.

#include <string_view>

#include "server/store/postgresql/connection.h"
#include "server/store/quota_check.h"

namespace snapthrough::server::postgresql {

/// @brief As check_quotas() of server/store/quota_check.h, of what the owner has at this moment. Others who
/// would add to what it has wait until this transaction ends.
[[nodiscard]] Status check_quotas(Connection& connection, std::string_view owner, const Quotas& quotas,
                                  const Usage& addition);

}  // namespace snapthrough::server::postgresql
