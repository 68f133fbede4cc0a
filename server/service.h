#pragma once
/// @file
/// The whole service: store, queue, workers and HTTP.

#include <memory>
#include <vector>

#include "server/config.h"
#include "server/environment.h"
#include "server/log/log.h"
#include "server/queue/pool.h"
#include "server/status.h"

namespace snapthrough::server {

/// @brief A service that runs from start() to stop(), which must be called from one thread.
class Service {
 public:
  /// @param runners factory of runners; empty: isolated_runners() (worker/isolated_runner.h)
  /// @pre config.check() is empty; `log` outlives the service
  Service(ServiceConfig config, Environment environment, RunnerFactory runners, Log& log);
  /// Calls stop() if necessary.
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  Service(Service&&) = delete;
  Service& operator=(Service&&) = delete;

  /// @brief Opens the store, requeues jobs that a dead process left running, starts workers, and listens if
  /// the configuration asks for it.
  Status start();
  /// Returns the port after start().
  [[nodiscard]] int port() const;
  /// @brief Replaces the accepted keys. Returns `unsupported` and changes nothing when the service was
  /// started with keys and `keys` is empty, or the reverse. @pre the service is started, and the keys are
  /// valid
  Status replace_keys(std::vector<http::ApiKey> keys);
  /// @brief Stops the service: refuses new work and reports not ready, but answers other requests for
  /// `drain_delay` and until running jobs are requeued. Then answers requests in flight (those that wait for
  /// a result get the job's status) and stops listening. May be called repeatedly.
  void stop();

 private:
  struct Parts;
  ServiceConfig config_;
  Environment environment_;
  RunnerFactory runners_;
  Log& log_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace snapthrough::server
