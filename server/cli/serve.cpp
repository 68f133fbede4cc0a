#include <malloc.h>

#include <csignal>
#include <ostream>
#include <system_error>

#include "server/cli/commands.h"
#include "server/environment.h"
#include "server/log/log.h"
#include "server/service.h"

namespace snapthrough::server::cli {
namespace {

/// Blocks SIGTERM, SIGINT and SIGHUP in all threads started later, so that wait() alone receives them.
class HeldSignals {
 public:
  HeldSignals() {
    std::signal(SIGPIPE, SIG_IGN);
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGTERM);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }
  ~HeldSignals() = default;
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  HeldSignals(HeldSignals&&) = delete;
  HeldSignals& operator=(HeldSignals&&) = delete;

  /// Waits for the next signal and returns it.
  [[nodiscard]] int wait() const {
    int signal = 0;
    sigwait(&signals_, &signal);
    return signal;
  }
  /// Unblocks the signals: SIGTERM and SIGINT end the process at once, SIGHUP is ignored.
  void release() const {
    std::signal(SIGHUP, SIG_IGN);
    pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
  }

 private:
  sigset_t signals_{};
};

/// Makes malloc return large freed blocks to the system and share arenas, so that memory of a large document
/// is not kept.
void keep_heap_small() {
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 2 << 20);
  ::mallopt(M_ARENA_MAX, 4);
}

/// Logs all settings; keys appear only as their number.
void log_config(Log& log, const ServiceConfig& config) {
  for (const Setting& setting : settings()) {
    const std::string value = setting.get(config);
    log.write(LogLevel::info, "setting",
              {{"name", std::string_view(setting.name)}, {"value", std::string_view(value)}});
  }
}

/// Reads the configuration again and replaces the keys; on an error all keys stay.
void reload_keys(const SettingSources& sources, const ServiceConfig& running, Service& service, Log& log) {
  auto [config, mistakes] = load_config(sources, running.front);
  const std::size_t count = config.keys.size();
  if (mistakes.empty()) {
    if (const Status status = service.replace_keys(std::move(config.keys)); !status.ok()) {
      mistakes.push_back({"keys", status.message()});
    }
  }
  for (const ConfigMistake& mistake : mistakes) {
    log.write(LogLevel::error, "reload",
              {{"field", std::string_view(mistake.field)}, {"detail", std::string_view(mistake.detail)}});
  }
  if (!mistakes.empty()) {
    return;
  }
  log.write(LogLevel::info, "reload", {{"keys", static_cast<std::int64_t>(count)}});
  for (const Setting& setting : settings()) {
    if (const std::string value = setting.get(config); value != setting.get(running)) {
      log.write(LogLevel::warning, "setting",
                {{"name", std::string_view(setting.name)},
                 {"value", std::string_view(value)},
                 {"detail", std::string_view("used from the next start on")}});
    }
  }
}

}  // namespace

int serve_command(const SettingSources& sources, bool front, const Streams& streams) {
  const auto [config, mistakes] = load_config(sources, front);
  for (const ConfigMistake& mistake : mistakes) {
    streams.err << mistake.field << ": " << mistake.detail << '\n';
  }
  if (!mistakes.empty()) {
    return kOther;
  }
  keep_heap_small();
  HeldSignals signals;
  const Environment environment = Environment::system();
  Log log(config.log_level, environment.now);
  log_config(log, config);
  Service service(config, environment, {}, log);
  if (const Status status = service.start(); !status.ok()) {
    streams.err << "snapthrough: " << status.message() << '\n';
    return kOther;
  }
  int signal = signals.wait();
  while (signal == SIGHUP && !sources.file.empty()) {
    reload_keys(sources, config, service, log);
    signal = signals.wait();
  }
  signals.release();  // a second signal ends the process
  log.write(LogLevel::info, "stopping", {{"signal", static_cast<std::int64_t>(signal)}});
  service.stop();
  return kDone;
}

}  // namespace snapthrough::server::cli
