#pragma once
/// @file
/// Time and randomness, which are given to the code that needs them so that tests decide them.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// A moment in UTC, to the microsecond.
using Time = std::chrono::sys_time<std::chrono::microseconds>;

/// What the service asks its surroundings. Each function must be callable from any thread.
struct Environment {
  std::function<Time()> now;                   ///< the wall clock, for time stamps
  std::function<double()> monotonic_seconds;   ///< for durations; the origin means nothing
  std::function<std::uint64_t()> random_bits;  ///< 64 unpredictable bits

  /// The real clock and the kernel's random numbers.
  [[nodiscard]] static Environment system();
};

/// RFC 3339 in UTC with microseconds, e.g. "2026-01-31T08:30:00.250000Z".
[[nodiscard]] std::string rfc3339(Time time);

/// @brief The time that a text of RFC 3339 means ("2026-01-31T08:30:00Z", with up to six digits of a
/// fraction, or an offset such as "+01:00"), or nothing when it is none or before 1970 or after 9999.
[[nodiscard]] std::optional<Time> time_from(std::string_view text);

/// HTTP date (RFC 9110, 5.6.7), e.g. "Sat, 31 Jan 2026 08:30:00 GMT".
[[nodiscard]] std::string http_date(Time time);

/// A new identifier: a UUID of version 7 (RFC 9562), 36 characters that sort by the millisecond of creation
/// and hold 74 random bits.
[[nodiscard]] std::string new_id(const Environment& environment);

/// Whether the text has the form of an identifier made by new_id().
[[nodiscard]] bool is_id(std::string_view text);

}  // namespace snapthrough::server
