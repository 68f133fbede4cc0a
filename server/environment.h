#pragma once
/// @file
/// Time and randomness, passed to the code that needs them so that tests can replace them.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// A point in time in UTC, in microseconds.
using Time = std::chrono::sys_time<std::chrono::microseconds>;

/// Access to clocks and random numbers. Each function must be callable from any thread.
struct Environment {
  std::function<Time()> now;                   ///< wall clock, for time stamps
  std::function<double()> monotonic_seconds;   ///< for durations, from an arbitrary origin
  std::function<std::uint64_t()> random_bits;  ///< 64 unpredictable bits

  /// Returns the system's clocks and random numbers.
  [[nodiscard]] static Environment system();
};

/// @brief Returns the monotonic clock as a time. It is comparable with its own times only, and goes on evenly
/// when the wall clock is set.
[[nodiscard]] inline Time steady_time(const Environment& environment) {
  const std::chrono::duration<double> seconds(environment.monotonic_seconds());
  return Time(std::chrono::floor<std::chrono::microseconds>(seconds));
}

/// Returns a time in RFC 3339 format in UTC with microseconds, such as "2026-01-31T08:30:00.250000Z".
[[nodiscard]] std::string rfc3339(Time time);

/// @brief Parses a time in RFC 3339 format ("2026-01-31T08:30:00Z", with up to six digits of fraction, or an
/// offset such as "+01:00"); nullopt for another format or a year outside 1970 to 9999.
[[nodiscard]] std::optional<Time> time_from(std::string_view text);

/// Returns an HTTP date (RFC 9110, 5.6.7), such as "Sat, 31 Jan 2026 08:30:00 GMT".
[[nodiscard]] std::string http_date(Time time);

/// Returns a new UUID of version 7 (RFC 9562): 36 characters that sort by the millisecond of creation, with
/// 74 random bits.
[[nodiscard]] std::string new_id(const Environment& environment);

/// Returns whether a text has the format of new_id().
[[nodiscard]] bool is_id(std::string_view text);

}  // namespace snapthrough::server
