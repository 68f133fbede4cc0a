#pragma once
/// @file
/// Rows of a sweep as they are stored: many together, packed.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/sweep.h"

namespace snapthrough::server::postgresql {

/// CBOR of the rows' columns, in a frame of zstd.
[[nodiscard]] std::string pack_rows(const std::vector<PointRow>& rows);
/// In the order they were packed; none of them is marked as reused. Throws Error with "XX001".
[[nodiscard]] std::vector<PointRow> unpack_rows(std::string_view bytes);

/// 64 bits of a key, to find rows by.
[[nodiscard]] std::int64_t short_key(std::string_view key);
/// Of rows that may be used elsewhere. A row that is itself reused is found where it came from.
[[nodiscard]] std::vector<std::int64_t> short_keys(const std::vector<PointRow>& rows);

}  // namespace snapthrough::server::postgresql
