#pragma once
/// @file
/// One JSON object a line: time, level, event, and the event's own fields.

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

/// The level of that name ("debug", "info", "warning", "error", "off"), or nothing.
[[nodiscard]] std::optional<LogLevel> log_level_from(std::string_view name);

/// A named value of a log line. The views must live until the call returns.
struct LogField {
  std::string_view name;
  std::variant<std::string_view, std::int64_t, double, bool> value;
};

/// @brief Writes log lines. Thread-safe; a line is never torn. Text that is not UTF-8 is repaired, so that
/// every line is valid JSON.
class Log {
 public:
  /// To a descriptor, standard error if none is given. It is never waited for: where nobody reads, lines are
  /// lost and counted.
  Log(LogLevel level, std::function<Time()> now, int descriptor = 2);
  /// To a stream that outlives the log.
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
