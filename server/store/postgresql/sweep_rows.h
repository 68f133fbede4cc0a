#pragma once
/// @file
/// Stored form of rows of a sweep: the rows of one lease are packed together.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/items.h"
#include "server/store/postgresql/connection.h"

namespace snapthrough::server::postgresql {

/// CBOR of the rows, column by column, in a frame of zstd.
[[nodiscard]] std::string pack_rows(const std::vector<PointRow>& rows);
/// The rows in the order in which they were packed; none is marked as reused. Throws Error with "XX001".
[[nodiscard]] std::vector<PointRow> unpack_rows(std::string_view bytes);

/// 64 bits of a key, by which rows are found.
[[nodiscard]] std::int64_t short_key(std::string_view key);

/// Inserts free items of a sweep.
[[nodiscard]] Statement insert_left(std::int64_t sweep, const ItemRun& run, std::int64_t crashes);

/// Stores rows of a lease that was ended, gives its other items out again, and ends the sweep if it is
/// complete.
/// @param alone result of hold_claims() of the schema: no other transaction ends a lease of the sweep
/// @param now see Clock::at()
void settle(Connection& connection, const HeldItems& lease, std::vector<PointRow> rows, bool alone,
            const std::optional<std::int64_t>& now);

}  // namespace snapthrough::server::postgresql
