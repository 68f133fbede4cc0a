#pragma once
/// @file
/// Configuration of the service.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/front/keys.h"
#include "server/front/listener_data.h"
#include "server/log/log.h"
#include "server/queue/job_service.h"
#include "server/resources/routes.h"
#include "server/webhooks/webhooks.h"
#include "server/worker/isolated_runner.h"

namespace snapthrough::server {

/// An invalid field of the configuration.
struct ConfigMistake {
  std::string field;   ///< name in ServiceConfig, such as "workers"
  std::string detail;  ///< the rule, as a sentence
};

/// Settings of the service; every field has a working default.
struct ServiceConfig {
  http::ListenerOptions listener;             ///< sockets; the host must be loopback without keys
  http::WaitLimits waits;                     ///< how long clients may wait for results
  std::vector<http::ApiKey> keys;             ///< accepted keys; empty: requests are not authenticated
  std::vector<std::string> allowed_origins;   ///< origins whose pages may use the service; exact match
  std::string store_path = "snapthrough.db";  ///< SQLite file in an existing folder, or postgresql://...
  int store_connections = 4;                  ///< connections to a database, beside one for each worker
  int workers = 1;  ///< analyses at a time, <= 1024; 0: processes that share the store work
  std::string runner_executable = own_executable();  ///< path of snapthrough; runners are started from it
  JobLimits jobs;                                    ///< queue, leases, retention, callback hosts
  std::string callback_secret_file;                  ///< secret that signs callbacks; empty: no callbacks
  WebhookTimes callback_times;
  std::string web{http::kEmbeddedPage};              ///< the page: built in, none, or a folder
  std::string hops_folder;                           ///< Grasshopper components; empty: built-in ones
  std::int64_t ballast_bytes = 4 * 1024 * 1024;      ///< reserve on the disk of the store; 0: none
  std::int64_t least_free_bytes = 64 * 1024 * 1024;  ///< bytes free on that disk below which jobs are refused
  std::chrono::seconds drain_delay{0};               ///< time from SIGTERM to the stop of workers
  LogLevel log_level = LogLevel::info;
  std::optional<std::pair<std::string, int>>
      observe;        ///< host and port for the state of a process that is no front; nullopt: none
  bool front = true;  ///< answers requests; false: only works on jobs of services that share the store

  /// Returns the default configuration, with one worker for each core.
  [[nodiscard]] static ServiceConfig defaults();
  /// Returns all invalid fields.
  [[nodiscard]] std::vector<ConfigMistake> check() const;
};

/// Splits "host:port" or "[ipv6]:port"; nullopt for another form or a port beyond 65535.
[[nodiscard]] std::optional<std::pair<std::string, int>> parse_address(std::string_view text);

}  // namespace snapthrough::server
