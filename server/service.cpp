#include "server/service.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "api/json_text.h"
#include "api/sweep.h"
#include "server/front/gateway.h"
#include "server/front/listener.h"
#include "server/front/listener_data.h"
#include "server/jobs/callback.h"
#include "server/jobs/envelope.h"
#include "server/maintenance/upkeep.h"
#include "server/neighbours/neighbours.h"
#include "server/queue/job_service.h"
#include "server/resources/routes.h"
#include "server/store/open_store.h"
#include "server/webhooks/signature.h"
#include "server/webhooks/webhooks.h"
#include "server/worker/isolated_runner.h"
#include "solver/model/limits.h"

namespace snapthrough::server {

namespace {

std::vector<std::pair<std::string, double>> published_limits(const ServiceConfig& config) {
  const http::HeadLimits& wire = config.listener.limits;
  const auto number = [](auto value) { return static_cast<double>(value); };
  const api::ParseLimits parse;
  return {{"body_bytes", number(wire.body_bytes)},
          {"head_bytes", number(wire.head_bytes)},
          {"header_count", number(wire.header_count)},
          {"target_bytes", number(wire.target_bytes)},
          {"buffered_bytes", number(wire.buffered_bytes)},
          {"json_depth", number(parse.depth)},
          {"json_values", number(parse.values)},
          {"json_keys", number(config.jobs.json_keys)},
          {"nodes", number(kMaxNodes)},
          {"members", number(kMaxMembers)},
          {"elements", number(kMaxElements)},
          {"order", number(kMaxOrder)},
          {"steps", number(kMaxSteps)},
          {"sweep_points", number(config.jobs.sweep_points)},
          {"sweep_parameters", number(api::kMaxSweepParameters)},
          {"sweep_targets", number(api::kMaxSweepTargets)},
          {"sweep_outputs", number(api::kMaxSweepOutputs)},
          {"sweeps", number(config.jobs.sweeps)},
          {"table_rows", number(config.jobs.table_rows)},
          {"label_characters", number(kLongestLabel)},
          {"metadata_members", number(kMostMetadata)},
          {"metadata_name_characters", number(kLongestMetadataName)},
          {"metadata_value_characters", number(kLongestMetadataValue)},
          {"callback_characters", number(kLongestCallback)},
          {"buckling_modes", number(kMaxModes)},
          {"monitors", number(kMaxMonitors)},
          {"state_points", number(kMaxStatePoints)},
          {"connections", number(config.listener.connections)},
          {"streams", number(config.listener.streams)},
          {"queue", number(config.jobs.queue)},
          {"quota_jobs_waiting", number(config.jobs.quotas.jobs_waiting)},
          {"quota_points_waiting", number(config.jobs.quotas.points_waiting)},
          {"quota_points_per_hour", number(config.jobs.quotas.points_per_hour)},
          {"quota_bytes_kept", number(config.jobs.quotas.bytes_kept)},
          {"workers", number(config.workers)},
          {"max_run_s", number(config.jobs.longest_run.count())},
          {"max_job_memory_bytes", number(config.jobs.job_memory)},
          {"max_crashes", number(config.jobs.max_crashes)},
          {"lease_s", number(config.jobs.lease.count())},
          {"default_wait_s", number(config.waits.default_wait.count())},
          {"longest_wait_s", number(config.waits.longest_wait.count())},
          {"keep_jobs_s", number(config.jobs.keep_jobs.count())},
          {"keep_keys_s", number(config.jobs.keep_keys.count())},
          {"keep_records_s", number(config.jobs.keep_records.count())}};
}

IsolatedRunnerOptions runner_options(const ServiceConfig& config) {
  return {config.runner_executable, config.jobs.job_memory, config.jobs.max_crashes};
}

/// Returns the guard of the store's disk; nullopt for a store that is no local file.
std::optional<DiskGuard> disk_guard(const ServiceConfig& config) {
  if (is_shared_location(config.store_path)) {
    return std::nullopt;
  }
  return DiskGuard(config.store_path, static_cast<std::uint64_t>(config.ballast_bytes),
                   static_cast<std::uint64_t>(config.least_free_bytes));
}

/// Returns the largest number of connections to a database: those for requests, and one for each worker and
/// spare worker, so that no worker waits for a connection while requests have all of theirs.
int connections_of(const ServiceConfig& config) {
  return config.store_connections + (config.workers > 0 ? config.workers + config.jobs.spare_workers : 0);
}

/// Returns the key that signs callbacks; "" without callbacks.
StatusOr<std::string> callback_key(const ServiceConfig& config) {
  if (config.jobs.callback_hosts.empty() || !config.front) {
    return std::string();
  }
  std::ifstream file(config.callback_secret_file);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::optional<std::string> key = webhook_key(text);
  if (!key) {
    return Status(StatusCode::unsupported, "callback_secret_file " + config.callback_secret_file +
                                               ": expected whsec_ and the base64 of 24 to 64 bytes");
  }
  return *std::move(key);
}

/// Returns the options of the listener of a front, or of the state of a process that is none.
http::ListenerOptions listener_options(const ServiceConfig& config) {
  http::ListenerOptions options = config.listener;
  if (!config.front && config.observe) {
    std::tie(options.host, options.port) = *config.observe;
  }
  return options;
}

}  // namespace

/// Parts of a running service, constructed in this order and destroyed in reverse.
struct Service::Parts {
  Parts(const ServiceConfig& config, const Environment& environment, const RunnerFactory& runners, Log& log,
        std::unique_ptr<Store> opened, std::string callback_key)
      : store(std::move(opened)),
        jobs(*store, environment, log, config.jobs),
        upkeep(jobs.context(), disk_guard(config)),
        workers(config.workers, jobs.context(),
                runners ? runners : isolated_runners(runner_options(config), runner_counters)),
        routes(jobs, config.waits,
               {[this] { return metrics_text(); }, [this] { return not_ready(); }, published_limits(config),
                http::Page(config.web), config.hops_folder}),
        keys(config.keys),
        gateway(routes, environment, log, keys, metrics, http::CrossOrigin(config.allowed_origins),
                config.front ? http::Answers::all : http::Answers::state),
        thread_wait(config.listener.times.thread),
        listener(listener_options(config), gateway),
        upkeep_thread(upkeep),
        webhooks({*store, environment, log, config.callback_times, webhook_counters},
                 config.front ? callback_origins(config.jobs.callback_hosts) : std::vector<std::string>(),
                 std::move(callback_key)) {
    if (NeighbourStore* const others = store->neighbours()) {
      neighbours = std::make_unique<Neighbours>(*others, jobs.context());
    }
  }

  [[nodiscard]] std::string metrics_text();
  [[nodiscard]] std::string not_ready() const;

  std::unique_ptr<Store> store;
  JobService jobs;
  Upkeep upkeep;
  RunnerCounters runner_counters;
  WorkerPool workers;
  http::RequestMetrics metrics;
  http::Routes routes;
  http::KeyRing keys;
  http::Gateway gateway;
  const std::chrono::milliseconds thread_wait;
  http::Listener listener;
  UpkeepThread upkeep_thread;
  WebhookCounters webhook_counters;
  Webhooks webhooks;
  std::unique_ptr<Neighbours> neighbours;
};

std::string Service::Parts::metrics_text() {
  std::string text;
  metrics.write(text);
  jobs.context().metrics.write(text);
  store->write_metrics(text);
  const Time now = jobs.environment().now();
  if (const StatusOr<std::optional<Time>> oldest = store->oldest_waiting(now); oldest.ok()) {
    write_metric(text, "snapthrough_oldest_waiting_job_seconds", "gauge",
                 "Since the oldest accepted job was handed in; 0 when none waits.",
                 std::max(0.0, std::chrono::duration<double>(now - oldest->value_or(now)).count()));
  }
  const http::ListenerLoad load = listener.load();
  const StoreHealth& health = jobs.context().health;
  const auto gauge = [&](const char* name, const char* help, double value) {
    write_metric(text, name, "gauge", help, value);
  };
  gauge("snapthrough_connections", "Open connections.", load.connections);
  gauge("snapthrough_streams", "Open streams of events.", load.streams);
  gauge("snapthrough_buffered_bytes", "Of incomplete requests and responses that are being sent.",
        static_cast<double>(load.buffered_bytes));
  gauge("snapthrough_thread_wait_seconds", "For which requests have waited because others have all threads.",
        std::chrono::duration<double>(load.longest_wait).count());
  gauge("snapthrough_jobs_waiting", "Accepted jobs, about.",
        static_cast<double>(jobs.context().waiting.value()));
  gauge("snapthrough_jobs_running", "Analyses of this process.",
        static_cast<double>(jobs.context().active.count()));
  const auto counter = [&](const char* name, const char* help, std::int64_t value) {
    write_metric(text, name, "counter", help, static_cast<double>(value));
  };
  counter("snapthrough_connections_without_memory_total", "Ended because there was no memory for them.",
          load.without_memory);
  gauge("snapthrough_sweeps_active", "Sweeps that points are given out of.",
        static_cast<double>(jobs.sweeps().work().count()));
  counter("snapthrough_runners_started_total", "Processes that compute, started.", runner_counters.started);
  counter("snapthrough_runners_out_of_memory_total", "Ended at the bound of their memory.",
          runner_counters.out_of_memory);
  counter("snapthrough_runners_killed_total", "Ended because they did not stop.", runner_counters.killed);
  counter("snapthrough_runners_crashed_total", "Ended otherwise.", runner_counters.crashed);
  gauge("snapthrough_workers_without_process",
        "Workers that wait until the system starts a process for them.",
        static_cast<double>(runner_counters.without_process));
  counter("snapthrough_callbacks_delivered_total", "Ends that a receiver took.", webhook_counters.delivered);
  counter("snapthrough_callback_attempts_failed_total", "Requests to receivers that failed.",
          webhook_counters.failed);
  counter("snapthrough_callbacks_given_up_total", "Ends that no receiver took.", webhook_counters.given_up);
  if (const StatusOr<std::int64_t> deliveries = store->deliveries().waiting(); deliveries.ok()) {
    gauge("snapthrough_callbacks_waiting", "Ends that a receiver has not taken yet.",
          static_cast<double>(*deliveries));
  }
  gauge("snapthrough_store_writable", "1 when the latest write went well.", health.writable ? 1 : 0);
  gauge("snapthrough_disk_has_space", "1 when new jobs are taken.", health.has_space ? 1 : 0);
  return text;
}

std::string Service::Parts::not_ready() const {
  const StoreHealth& health = jobs.context().health;
  if (health.draining) {
    return "The service is stopping.";
  }
  if (!health.writable) {
    return "The store can't be written.";
  }
  if (!health.has_space) {
    return "The disk of the store is nearly full.";
  }
  if (jobs.context().waiting.value() >= jobs.limits().queue) {
    return "The queue is full.";
  }
  if (runner_counters.without_process > 0) {
    return "The system starts no process for an analysis: too many descriptors or processes, or too little "
           "memory.";
  }
  if (listener.load().longest_wait > thread_wait) {
    return "The front cannot answer: requests wait for a thread for longer than " +
           std::to_string(thread_wait.count()) + " ms.";
  }
  return store->get("").ok() ? "" : "The store can't be read.";
}

Service::Service(ServiceConfig config, Environment environment, RunnerFactory runners, Log& log)
    : config_(std::move(config)),
      environment_(std::move(environment)),
      runners_(std::move(runners)),
      log_(log) {}

Service::~Service() { stop(); }

Status Service::start() {
  StatusOr<std::string> key = callback_key(config_);
  if (!key.ok()) {
    return key.status();
  }
  StatusOr<std::unique_ptr<Store>> store =
      open_store(config_.store_path, connections_of(config_), environment_.now());
  if (!store.ok()) {
    return store.status();
  }
  std::unique_ptr<Store> opened = std::move(store).value();
  const StatusOr<Recovery> recovery = opened->recover(config_.jobs.max_crashes, environment_.now());
  if (!recovery.ok()) {
    return recovery.status();
  }
  log_recovery(log_, *recovery, "the service died while it worked on this job");
  const StatusOr<std::int64_t> points =
      opened->sweeps().recover(config_.jobs.max_crashes, environment_.now());
  if (!points.ok()) {
    return points.status();
  }
  if (*points > 0) {
    log_.write(LogLevel::warning, "sweep",
               {{"units", *points},
                {"detail", std::string_view("the service died while it worked on these units")}});
  }
  parts_ = std::make_unique<Parts>(config_, environment_, runners_, log_, std::move(opened),
                                   std::move(key).value());
  for (std::size_t i = 0; i < recovery->failed.size(); ++i) {
    parts_->jobs.context().metrics.job_ended("crashed");
  }
  const bool listens = config_.front || config_.observe;
  if (Status status = listens ? parts_->listener.start() : Status(); !status.ok()) {
    stop();
    return status;
  }
  const std::string location = shown_location(config_.store_path);
  log_.write(LogLevel::info, config_.front ? "listening" : "working",
             {{"host", std::string_view(listens ? listener_options(config_).host : "")},
              {"port", static_cast<std::int64_t>(listens ? port() : 0)},
              {"store", std::string_view(location)},
              {"instance", std::string_view(parts_->jobs.context().instance)},
              {"workers", static_cast<std::int64_t>(config_.workers)},
              {"keys", static_cast<std::int64_t>(config_.keys.size())}});
  return {};
}

int Service::port() const { return parts_ ? parts_->listener.port() : 0; }

Status Service::replace_keys(std::vector<http::ApiKey> keys) {
  if (keys.empty() != config_.keys.empty()) {
    return {StatusCode::unsupported, "whether keys are asked for at all is decided at the start"};
  }
  parts_->keys.replace(std::move(keys));
  return {};
}

void Service::stop() {
  if (!parts_) {
    return;
  }
  const WorkerContext& context = parts_->jobs.context();
  context.health.draining = true;
  parts_->listener.begin_drain();
  std::this_thread::sleep_for(config_.drain_delay);
  parts_->store->hurry();
  parts_->workers.stop();
  context.completions.close();  // after the workers: waiting clients then get the final status of their jobs
  parts_->listener.stop();
  parts_.reset();
  log_.write(LogLevel::info, "stopped");
}

}  // namespace snapthrough::server
