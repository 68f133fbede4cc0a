#include "server/log/log.h"

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "server/log/pipe_sink.h"

namespace snapthrough::server {
namespace {

struct LevelName {
  LogLevel level;
  std::string_view name;
  spdlog::level::level_enum spdlog_level;
};
constexpr std::array kLevels{LevelName{LogLevel::debug, "debug", spdlog::level::debug},
                             LevelName{LogLevel::info, "info", spdlog::level::info},
                             LevelName{LogLevel::warning, "warning", spdlog::level::warn},
                             LevelName{LogLevel::error, "error", spdlog::level::err},
                             LevelName{LogLevel::off, "off", spdlog::level::off}};

const LevelName& level_row(LogLevel level) { return kLevels[static_cast<std::size_t>(level)]; }

}  // namespace

struct Log::Sink {
  Sink(LogLevel level, spdlog::sink_ptr sink) : logger("snapthrough", std::move(sink)) {
    logger.set_pattern("%v");
    logger.set_level(level_row(level).spdlog_level);
    logger.flush_on(spdlog::level::trace);
  }
  spdlog::logger logger;
};

std::optional<LogLevel> log_level_from(std::string_view name) {
  for (const LevelName& row : kLevels) {
    if (row.name == name) {
      return row.level;
    }
  }
  return std::nullopt;
}

Log::Log(LogLevel level, std::function<Time()> now, int descriptor)
    : sink_(std::make_unique<Sink>(level, std::make_shared<PipeSink>(descriptor))), now_(std::move(now)) {}

Log::Log(LogLevel level, std::function<Time()> now, std::ostream& stream)
    : sink_(std::make_unique<Sink>(level, std::make_shared<spdlog::sinks::ostream_sink_mt>(stream))),
      now_(std::move(now)) {}

Log::~Log() = default;

void Log::write(LogLevel level, std::string_view event, std::initializer_list<LogField> fields) {
  const LevelName& row = level_row(level);
  if (!sink_->logger.should_log(row.spdlog_level)) {
    return;
  }
  nlohmann::ordered_json line{{"time", rfc3339(now_())}, {"level", row.name}, {"event", event}};
  for (const LogField& field : fields) {
    std::visit([&](const auto& value) { line[std::string(field.name)] = value; }, field.value);
  }
  sink_->logger.log(row.spdlog_level, line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void Log::is_away(std::string_view what, std::string_view detail) {
  {
    const std::lock_guard guard(mutex_);
    if (++away_[std::string(what)] > 1) {
      return;
    }
  }
  write(LogLevel::error, what, {{"detail", detail}});
}

void Log::is_back(std::string_view what) {
  std::int64_t count = 0;
  {
    const std::lock_guard guard(mutex_);
    const auto away = away_.find(what);
    if (away == away_.end()) {
      return;
    }
    count = away->second;
    away_.erase(away);
  }
  write(LogLevel::info, what, {{"detail", std::string_view("can be used again")}, {"failures", count}});
}

void log_store_trouble(Log& log, const Status& status) {
  if (status.code() == StatusCode::unavailable) {
    log.is_away("store", status.message());
  } else {
    log.write(LogLevel::error, "store", {{"detail", std::string_view(status.message())}});
  }
}

}  // namespace snapthrough::server
