#pragma once
/// @file
/// The whole service: store, queue, workers and HTTP, put together.

#include <memory>
#include <vector>

#include "server/config.h"
#include "server/environment.h"
#include "server/log/log.h"
#include "server/queue/pool.h"
#include "server/status.h"

namespace snapthrough::server {

/// @brief A service that runs from start() to stop(). start() and stop() from one thread.
class Service {
 public:
  /// @param runners what computes; empty: processes of their own (worker/child_runner.h)
  /// @pre config.check() is empty; `log` outlives the service
  Service(ServiceConfig config, Environment environment, RunnerFactory runners, Log& log);
  /// Stops first if need be.
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  Service(Service&&) = delete;
  Service& operator=(Service&&) = delete;

  /// @brief Opens the store, puts jobs that a dead process left running back, starts workers, and listens if
  /// it is a front.
  Status start();
  /// The port that is listened to, once started.
  [[nodiscard]] int port() const;
  /// @brief Accepts these keys from now on and no others. `unsupported`, and nothing changes, when the
  /// service was started with keys and these are none, or the other way round. @pre started; the keys are
  /// valid
  Status replace_keys(std::vector<http::ApiKey> keys);
  /// @brief Takes no new work and is not ready from now on, but answers everything else: for `drain_delay`,
  /// and until running jobs are back in the queue. Then answers requests in flight (those that wait for a
  /// result get the job's status) and stops listening. Repeatable.
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
