#pragma once
/// @file
/// Log of one JSON object a line: time, level, event, and fields of the event.

#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "server/environment.h"
#include "server/status.h"

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

  /// Writes an error line that something cannot be used, unless one was written since it last could.
  /// @param what name of the event @param detail cause
  void is_away(std::string_view what, std::string_view detail);
  /// Writes that it can be used again, and how often is_away() was called; nothing if that was never.
  void is_back(std::string_view what);

 private:
  struct Sink;
  std::unique_ptr<Sink> sink_;
  std::function<Time()> now_;
  std::mutex mutex_;
  std::map<std::string, std::int64_t, std::less<>> away_;  ///< calls of is_away() by what cannot be used
};

/// Writes that the store failed: what keeps it from being used (`unavailable`) once, see Log::is_away().
void log_store_trouble(Log& log, const Status& status);

}  // namespace snapthrough::server
