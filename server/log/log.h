#pragma once
/// @file
/// Log of one JSON object a line: time, level, event, and fields of the event.

#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

#include "server/environment.h"

namespace snapthrough::server {

enum class LogLevel { debug, info, warning, error, off };

/// Returns the level with a name ("debug", "info", "warning", "error", "off"); nullopt for another name.
[[nodiscard]] std::optional<LogLevel> log_level_from(std::string_view name);

/// A named value of a log line. The views must live until the call returns.
struct LogField {
  std::string_view name;
  std::variant<std::string_view, std::int64_t, double, bool> value;
};

/// @brief Writes log lines. Thread-safe; lines are not interleaved. Invalid UTF-8 is replaced, so that every
/// line is valid JSON.
class Log {
 public:
  /// Writes to a descriptor (default: standard error) without blocking: when its reader is too slow, lines
  /// are dropped and counted.
  Log(LogLevel level, std::function<Time()> now, int descriptor = 2);
  /// Writes to a stream, which must outlive the log.
  Log(LogLevel level, std::function<Time()> now, std::ostream& stream);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  Log(Log&&) = delete;
  Log& operator=(Log&&) = delete;

  void write(LogLevel level, std::string_view event, std::initializer_list<LogField> fields = {});

 private:
  struct Sink;
  std::unique_ptr<Sink> sink_;
  std::function<Time()> now_;
};

}  // namespace snapthrough::server
