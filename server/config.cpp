#include "server/config.h"

#include <algorithm>
#include <filesystem>
#include <thread>

#include "api/sweep.h"
#include "server/authority.h"
#include "server/front/cross_origin.h"
#include "server/jobs/callback.h"
#include "server/store/open_store.h"

namespace snapthrough::server {
namespace {

constexpr int kMostWorkers = 1024;
constexpr int kMostConnections = 64;
constexpr std::size_t kMostCallbackHosts = 16;  // each host needs one or two threads

bool is_digest(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Checks the settings of store and workers.
template <class Require>
void check_store(const ServiceConfig& config, const Require& require) {
  require(!config.store_path.empty(), "store_path", "must name a file, or a database as postgresql://...");
  require(config.store_connections >= 1 && config.store_connections <= kMostConnections, "store_connections",
          "must be 1 to 64");
  const bool shared = is_shared_location(config.store_path);
  require(
      config.front || shared, "store_path",
      "must be a store that other processes use, too: postgresql://..., since this one answers no requests");
  require(config.workers >= 1 || (config.workers == 0 && config.front && shared), "workers",
          "must be >= 1; 0 where other processes share the store (postgresql://...) and work on it");
  require(config.workers <= kMostWorkers, "workers", "must be <= 1024");
  require(config.jobs.lease.count() >= (shared ? 3 : 1), "jobs.lease",
          "must be >= 1 s; >= 3 s where other processes share the store, since it is renewed each second");
}

template <class Require>
void check_sizes(const JobLimits& jobs, const Require& require) {
  require(jobs.queue >= 1, "jobs.queue", "must be >= 1");
  require(jobs.spare_workers >= 0 && jobs.spare_workers <= kMostWorkers, "jobs.spare_workers",
          "must be 0 to 1024");
  require(jobs.sweeps >= 1, "jobs.sweeps", "must be >= 1");
  require(jobs.sweep_points >= 1 && static_cast<std::uint64_t>(jobs.sweep_points) <= api::kMaxSweepPoints,
          "jobs.sweep_points", "must be 1 to 1000000");
  require(jobs.json_keys >= 1, "jobs.json_keys", "must be >= 1");
  require(jobs.table_rows >= 1, "jobs.table_rows", "must be >= 1");
}

template <class Require>
void check_quotas(const Quotas& quotas, const Require& require) {
  require(quotas.jobs_waiting >= 0, "jobs.quotas.jobs_waiting", "must be >= 0");
  require(quotas.points_waiting >= 0, "jobs.quotas.points_waiting", "must be >= 0");
  require(quotas.points_per_hour >= 0, "jobs.quotas.points_per_hour", "must be >= 0");
  require(quotas.bytes_kept >= 0, "jobs.quotas.bytes_kept", "must be >= 0");
}

}  // namespace

ServiceConfig ServiceConfig::defaults() {
  ServiceConfig config;
  config.workers = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostWorkers);
  return config;
}

std::vector<ConfigMistake> ServiceConfig::check() const {
  std::vector<ConfigMistake> mistakes;
  const auto require = [&](bool holds, const char* field, const char* detail) {
    if (!holds) {
      mistakes.push_back({field, detail});
    }
  };
  static constexpr const char* kLoopback =
      "without keys requests are not authenticated, so the service listens on loopback only (127.0.0.1, "
      "::1, localhost)";
  require(!front || !keys.empty() || is_loopback(listener.host), "listener.host", kLoopback);
  require(front || !observe || !keys.empty() || is_loopback(observe->first), "observe", kLoopback);
  require(listener.port >= 0 && listener.port <= 65535, "listener.port", "must be 0 (any) to 65535");
  require(listener.threads >= 1 && listener.threads <= 900, "listener.threads", "must be 1 to 900");
  require(listener.connections >= 1, "listener.connections", "must be >= 1");
  require(listener.streams >= 0, "listener.streams", "must be >= 0");
  require(listener.limits.body_bytes > 0, "listener.limits.body_bytes", "must be > 0");
  require(listener.limits.buffered_bytes >= listener.limits.body_bytes, "listener.limits.buffered_bytes",
          "must be >= listener.limits.body_bytes");
  require(waits.default_wait.count() >= 0, "waits.default_wait", "must be >= 0");
  require(waits.longest_wait >= waits.default_wait, "waits.longest_wait", "must be >= waits.default_wait");
  check_store(*this, require);
  require(jobs.max_crashes >= 1, "jobs.max_crashes", "must be >= 1");
  check_sizes(jobs, require);
  check_quotas(jobs.quotas, require);
  require(jobs.longest_run.count() >= 1, "jobs.longest_run", "must be >= 1 s");
  require(jobs.job_memory >= kLeastJobMemory, "jobs.job_memory", "must be >= 1048576 bytes");
  require(jobs.keep_jobs.count() >= 0, "jobs.keep_jobs", "must be >= 0");
  require(jobs.keep_keys.count() >= 0, "jobs.keep_keys", "must be >= 0");
  require(jobs.keep_records.count() >= 0, "jobs.keep_records", "must be >= 0");
  require(web == http::kEmbeddedPage || web == http::kNoPage ||
              std::filesystem::is_regular_file(std::filesystem::path(web) / "index.html"),
          "web", "must be built-in, none, or a folder with the index.html of the page");
  require(hops_folder.empty() || std::filesystem::is_directory(hops_folder), "hops_folder",
          "must be a folder with a sweep document NAME.json for each component");
  require(ballast_bytes >= 0, "ballast_bytes", "must be >= 0");
  require(least_free_bytes >= 0, "least_free_bytes", "must be >= 0");
  for (const std::string& origin : allowed_origins) {
    require(http::is_origin(origin), "allowed_origins",
            "each must be an exact origin as browsers send it, e.g. https://app.example or "
            "http://localhost:5173: no *, no path, no port that is the scheme's own");
  }
  for (const std::string& host : jobs.callback_hosts) {
    require(
        is_callback_host(host), "jobs.callback_hosts",
        "each must be an exact host or host:port in lower case, e.g. hooks.example or localhost:9000: no *, "
        "no scheme, no path");
  }
  require(jobs.callback_hosts.size() <= kMostCallbackHosts, "jobs.callback_hosts", "must be at most 16");
  require(jobs.callback_hosts.empty() || !callback_secret_file.empty(), "callback_secret_file",
          "must name a file with the secret that callbacks are signed with, since there are callback_hosts");
  for (const http::ApiKey& key : keys) {
    require(!key.owner.empty(), "keys.owner", "must not be empty");
    require(is_digest(key.sha256), "keys.sha256", "must be 64 lower-case hexadecimal digits");
    require(!key.scopes.empty(), "keys.scopes", "must have read, submit or metrics");
  }
  return mistakes;
}

std::optional<std::pair<std::string, int>> parse_address(std::string_view text) {
  const Authority authority = Authority::of(text);
  const std::string_view host = without_brackets(authority.host);
  const std::optional<int> port = read_port(authority.port.value_or(""));
  if (host.empty() || !port) {
    return std::nullopt;
  }
  return std::pair(std::string(host), *port);
}

}  // namespace snapthrough::server
