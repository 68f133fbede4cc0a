#pragma once
/// @file
/// What can be set for the service.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/front/keys.h"
#include "server/front/listener.h"
#include "server/log/log.h"
#include "server/queue/job_service.h"
#include "server/resources/routes.h"
#include "server/webhooks/webhook_times.h"

namespace snapthrough::server {

/// A field of the configuration that cannot be used.
struct ConfigMistake {
  std::string field;   ///< as in ServiceConfig, e.g. "workers"
  std::string detail;  ///< a sentence with the rule
};

/// Settings of the service; every field has a working default.
struct ServiceConfig {
  http::ListenerOptions listener;             ///< without keys a loopback address
  http::WaitLimits waits;                     ///< how long clients may wait for results
  std::vector<http::ApiKey> keys;             ///< empty: requests are not authenticated
  std::vector<std::string> allowed_origins;   ///< pages of these may use the service, too; exact
  std::string store_path = "snapthrough.db";  ///< SQLite file, its folder must exist; or postgresql://...
  int store_connections = 4;                  ///< to a database, of this process
  int workers = 1;  ///< analyses at the same time, to 1024; 0: others that share the store work
  std::string runner_executable = "/proc/self/exe";  ///< snapthrough; what computes is started from it
  JobLimits jobs;                                    ///< queue, leases, retention, hosts of callbacks
  std::string callback_secret_file;  ///< what callbacks are signed with; empty: there are none
  WebhookTimes callback_times;
  std::string web{http::kEmbeddedPage};              ///< the page: built in, none, or a folder
  std::string hops_folder;                           ///< components of Grasshopper; empty: the built-in ones
  std::int64_t ballast_bytes = 4 * 1024 * 1024;      ///< reserve on the disk of the store; 0: none
  std::int64_t least_free_bytes = 64 * 1024 * 1024;  ///< with less on that disk no jobs are taken
  std::chrono::seconds drain_delay{0};               ///< from SIGTERM until workers are stopped
  LogLevel log_level = LogLevel::info;
  std::optional<std::pair<std::string, int>>
      observe;  ///< host and port at which one that is no front tells how it is; empty: nowhere
  bool front =
      true;  ///< answers requests; else it only works on what others, who share the store, were given

  /// One worker for each core.
  [[nodiscard]] static ServiceConfig defaults();
  /// Every field that cannot be used.
  [[nodiscard]] std::vector<ConfigMistake> check() const;
};

/// Splits "host:port" or "[ipv6]:port"; nothing when it has another form or the port is not 0 to 65535.
[[nodiscard]] std::optional<std::pair<std::string, int>> parse_address(std::string_view text);

}  // namespace snapthrough::server
