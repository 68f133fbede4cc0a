#pragma once
/// @file
/// The whole service: store, queue, workers and HTTP, put together.

#include <memory>

#include "server/config.h"
#include "server/environment.h"
#include "server/log/log.h"
#include "server/status.h"
#include "server/worker/pool.h"

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

  /// @brief Opens the store, puts jobs that a dead process left running back, starts workers, listens.
  Status start();
  /// The port that is listened to, once started.
  [[nodiscard]] int port() const;
  /// @brief Stops listening, answers requests in flight (those that wait for a result get the job's status),
  /// and puts running jobs back to the queue. Repeatable.
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
