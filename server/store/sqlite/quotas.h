#pragma once
/// @file
/// What an owner has, held against what it may have.

#include <string_view>

#include "server/store/quota_check.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// As check_quotas() of server/store/quota_check.h, of what the owner has at this moment.
[[nodiscard]] Status check_quotas(const Connection& connection, std::string_view owner, const Quotas& quotas,
                                  const Usage& addition);

}  // namespace snapthrough::server::sqlite
