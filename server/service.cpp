#include "server/service.h"

#include <utility>

#include "server/http/gateway.h"
#include "server/http/listener.h"
#include "server/http/routes.h"
#include "server/jobs/desk.h"
#include "server/store/sqlite/sqlite_store.h"

namespace snapthrough::server {

/// Built bottom up; destroyed top down.
struct Service::Parts {
  Parts(const ServiceConfig& config, const Environment& environment, SolveFunction solve, Log& log,
        std::unique_ptr<Store> opened)
      : store(std::move(opened)),
        desk(*store, environment, log),
        workers(config.workers, desk, std::move(solve), log),
        routes(desk, config.waits),
        gateway(routes, environment, log),
        listener(config.listener, gateway) {}

  std::unique_ptr<Store> store;
  JobDesk desk;
  WorkerPool workers;
  http::Routes routes;
  http::Gateway gateway;
  http::Listener listener;
};

namespace {

void log_recovery(Log& log, const Recovery& recovery) {
  for (const std::string& id : recovery.requeued) {
    log.write(LogLevel::warning, "job",
              {{"job", std::string_view(id)},
               {"status", to_string(JobState::accepted)},
               {"detail", std::string_view("the service died while it worked on this job")}});
  }
  for (const std::string& id : recovery.failed) {
    log.write(LogLevel::error, "job",
              {{"job", std::string_view(id)},
               {"status", to_string(JobState::failed)},
               {"code", std::string_view("crashed")}});
  }
}

}  // namespace

Service::Service(ServiceConfig config, Environment environment, SolveFunction solve, Log& log)
    : config_(std::move(config)), environment_(std::move(environment)), solve_(std::move(solve)), log_(log) {}

Service::~Service() { stop(); }

Status Service::start() {
  StatusOr<std::unique_ptr<Store>> store = sqlite::open_store(config_.store_path, environment_.now());
  if (!store.ok()) {
    return store.status();
  }
  std::unique_ptr<Store> opened = std::move(store).value();
  const StatusOr<Recovery> recovery = opened->recover(config_.max_crashes, environment_.now());
  if (!recovery.ok()) {
    return recovery.status();
  }
  log_recovery(log_, *recovery);
  parts_ = std::make_unique<Parts>(config_, environment_, solve_, log_, std::move(opened));
  if (Status status = parts_->listener.start(); !status.ok()) {
    stop();
    return status;
  }
  log_.write(LogLevel::info, "listening",
             {{"host", std::string_view(config_.listener.host)},
              {"port", static_cast<std::int64_t>(port())},
              {"store", std::string_view(config_.store_path)},
              {"workers", static_cast<std::int64_t>(config_.workers)}});
  return {};
}

int Service::port() const { return parts_ ? parts_->listener.port() : 0; }

void Service::stop() {
  if (!parts_) {
    return;
  }
  parts_->desk.ends().close();
  parts_->listener.stop();
  parts_->workers.stop();
  parts_.reset();
  log_.write(LogLevel::info, "stopped");
}

}  // namespace snapthrough::server
