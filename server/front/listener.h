#pragma once
/// @file
/// The sockets: waits for clients without giving a thread to one that is silent or slow.

#include <chrono>
#include <memory>
#include <string>

#include "server/front/gateway.h"
#include "server/front/request_head.h"
#include "server/status.h"

namespace snapthrough::server::http {

/// How long a client may take.
struct ClientTimes {
  std::chrono::milliseconds idle{75'000};  ///< until the first byte of a request
  std::chrono::milliseconds head{10'000};  ///< from the first byte to the end of the head
  std::chrono::milliseconds body{60'000};  ///< for the body
  std::chrono::milliseconds send{30'000};  ///< to take some of a response
  std::chrono::milliseconds ping{15'000};  ///< between signs of life on a stream without events
  std::chrono::milliseconds drain{2'000};  ///< for what is being received or sent when the service stops
};

/// Where and how to listen.
struct ListenerOptions {
  std::string host = "127.0.0.1";
  int port = 8080;           ///< 0: any free port
  int threads = 32;          ///< requests worked on at the same time; more wait
  int connections = 10'000;  ///< open at the same time; the next is refused with 503
  int streams = 200;         ///< server-sent events at the same time; the next is refused with 503
  HeadLimits limits;
  ClientTimes times;
};

/// What is open now.
struct ListenerLoad {
  int connections = 0;
  int streams = 0;
  std::size_t buffered_bytes = 0;  ///< of incomplete requests, and of responses that are being sent
};

/// @brief Accepts connections and serves their requests through a gateway, which must outlive it.
///
/// All sockets wait in one epoll set. A thread takes a socket that is ready, reads what is there, and works
/// only when a request is complete; a response that waits for a job and a stream hold no thread either.
/// Thread safety: start() and stop() from one thread, load() from any.
class Listener {
 public:
  Listener(ListenerOptions options, Gateway& gateway);
  /// Stops first if need be.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  Listener(Listener&&) = delete;
  Listener& operator=(Listener&&) = delete;

  /// Binds, and serves from threads of its own. `unavailable` when the address can't be bound.
  Status start();
  /// The port that is listened to, once started.
  [[nodiscard]] int port() const;
  [[nodiscard]] ListenerLoad load() const;
  /// Accepts nothing more, lets requests in flight finish, closes idle connections, and returns then.
  /// Repeatable.
  void stop();

 private:
  class Server;
  std::shared_ptr<Server> server_;
};

}  // namespace snapthrough::server::http
