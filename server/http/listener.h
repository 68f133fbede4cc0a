#pragma once
/// @file
/// The sockets: the only place that sees the HTTP library.

#include <memory>
#include <string>

#include "server/http/connection.h"
#include "server/http/gateway.h"
#include "server/status.h"

namespace snapthrough::server::http {

/// Where and how to listen.
struct ListenerOptions {
  std::string host = "127.0.0.1";
  int port = 8080;   ///< 0: any free port
  int threads = 64;  ///< connections served at the same time; more wait
  WireLimits limits;
  WireTimes times;
};

/// @brief Accepts connections and serves their requests through a gateway, which must outlive it.
/// Thread safety: start() and stop() from one thread.
class Listener {
 public:
  Listener(ListenerOptions options, Gateway& gateway);
  /// Stops first if need be.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  Listener(Listener&&) = delete;
  Listener& operator=(Listener&&) = delete;

  /// Binds, and serves from a thread of its own. `unavailable` when the address can't be bound.
  Status start();
  /// The port that is listened to, once started.
  [[nodiscard]] int port() const;
  /// Accepts nothing more, lets requests in flight finish, closes idle connections, and returns then.
  /// Repeatable.
  void stop();

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace snapthrough::server::http
