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

/// Holds SIGTERM and SIGINT back from every thread made after it, so that one place waits for them.
class HeldSignals {
 public:
  HeldSignals() {
    std::signal(SIGPIPE, SIG_IGN);
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGTERM);
    sigaddset(&signals_, SIGINT);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~HeldSignals() { release(); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  HeldSignals(HeldSignals&&) = delete;
  HeldSignals& operator=(HeldSignals&&) = delete;

  /// The first signal that comes.
  [[nodiscard]] int wait() const {
    int signal = 0;
    sigwait(&signals_, &signal);
    return signal;
  }
  /// From now on a signal ends the process at once.
  void release() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t signals_{};
  sigset_t before_{};
};

/// Large blocks go back to the system when they are freed, and threads share arenas: one wide document shall
/// not leave the process larger for ever.
void keep_heap_small() {
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 2 << 20);
  ::mallopt(M_ARENA_MAX, 4);
}

/// The configuration as it is used; keys are counted, not shown.
void log_config(Log& log, const ServiceConfig& config) {
  for (const Setting& setting : settings()) {
    const std::string value = setting.get(config);
    log.write(LogLevel::info, "setting",
              {{"name", std::string_view(setting.name)}, {"value", std::string_view(value)}});
  }
}

}  // namespace

int serve_command(const SettingSources& sources, const Streams& streams) {
  const auto [config, mistakes] = load_config(sources);
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
  const int signal = signals.wait();
  signals.release();  // who signals twice does not want to wait
  log.write(LogLevel::info, "stopping", {{"signal", static_cast<std::int64_t>(signal)}});
  service.stop();
  return kDone;
}

}  // namespace snapthrough::server::cli
