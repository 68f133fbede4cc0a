#pragma once
/// @file
/// Sockets of the service: a silent or slow client does not occupy a thread.

#include <memory>

#include "server/front/gateway.h"
#include "server/front/listener_data.h"
#include "server/status.h"

namespace snapthrough::server::http {

class ListenerServer;

/// @brief Accepts connections and serves their requests through a gateway, which must outlive the listener.
///
/// All sockets wait in one epoll set. A thread takes a ready socket, reads what has arrived, and computes
/// only when a request is complete. A response that waits for a job holds no thread, nor does a stream.
/// Thread safety: start() and stop() from one thread, load() from any.
class Listener {
 public:
  Listener(ListenerOptions options, Gateway& gateway);
  /// Calls stop() if necessary.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  Listener(Listener&&) = delete;
  Listener& operator=(Listener&&) = delete;

  /// Binds the address and starts the threads. `unavailable` when the address cannot be bound.
  Status start();
  /// Returns the port after start().
  [[nodiscard]] int port() const;
  [[nodiscard]] ListenerLoad load() const;
  /// Announces a stop: from now on each response closes its connection (`Connection: close`), so that clients
  /// find few open ones when the listener stops.
  void begin_drain();
  /// Stops accepting, completes requests in flight, closes idle connections, then returns. May be called
  /// repeatedly. A request that arrives within `settle` of the last response on its connection, or of its
  /// opening, is answered.
  void stop();

 private:
  std::shared_ptr<ListenerServer> server_;
};

}  // namespace snapthrough::server::http
