#pragma once
/// @file
/// Rows of usage and events, for drivers of stores.

#include <algorithm>
#include <cstdint>
#include <optional>

#include "server/store/driver.h"
#include "server/store/ledger_store.h"

namespace snapthrough::server {

/// The first hour since 1970 that begins at a time or after it.
[[nodiscard]] inline std::int64_t first_hour(Time time) {
  return std::chrono::ceil<std::chrono::hours>(time.time_since_epoch()).count();
}

/// Columns hour, label, jobs, points, cpu_us, peak_bytes, factorizations.
[[nodiscard]] inline UsageRow read_usage_row(const Row& row) {
  return {Time(std::chrono::hours(row.integer(0))),
          row.text(1),
          row.integer(2),
          row.integer(3),
          {row.integer(4), row.integer(5), row.integer(6)}};
}

/// Columns number, at_us, event, sweep (0 or 1), entry.
[[nodiscard]] inline AuditEntry read_audit_entry(const Row& row) {
  const std::string name = row.text(2);
  const auto event = std::find(kAuditEventNames.begin(), kAuditEventNames.end(), name);
  if (event == kAuditEventNames.end()) {
    row.refuse("unknown event in the store: " + name);
  }
  return {row.integer(0), row.time(1), static_cast<AuditEvent>(event - kAuditEventNames.begin()),
          row.integer(3) != 0, row.text(4)};
}

/// Time until the points of the oldest minute of an hour do not count any more. @param minute since 1970
[[nodiscard]] inline std::chrono::seconds until_more(std::optional<std::int64_t> minute,
                                                     std::int64_t now_us) {
  return minute ? std::chrono::seconds(std::max<std::int64_t>(1, (*minute + 60) * 60 - now_us / 1'000'000))
                : std::chrono::seconds(0);
}

}  // namespace snapthrough::server
