#pragma once
/// @file
/// One client's connection, as the listener keeps it.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "server/front/request_reader.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// What a connection waits for.
enum class Phase {
  idle,       ///< the first byte of a request
  head,       ///< the rest of a head
  body,       ///< the rest of a body
  in_row,     ///< its turn to be worked on
  deferred,   ///< what its response depends on
  sending,    ///< the client, to take the response
  streaming,  ///< events to send
  lingering,  ///< the client, to read a refusal and go
  closed
};

/// What a stream's source wants sent. Thread-safe.
class Outbox {
 public:
  /// False when the client is gone, or so slow that too much waits already.
  bool put(std::string piece, bool last);
  /// Takes what waits; `last` becomes true when nothing follows it.
  std::string take(bool& last);
  /// Nothing more can be sent.
  void close();
  /// Whether that is so, because it was closed or too much was put.
  [[nodiscard]] bool closed();

 private:
  std::mutex mutex_;
  std::string waiting_;
  bool last_ = false;
  bool closed_ = false;
};

/// @brief A connection. Whoever holds `mutex` may use it; nothing here locks.
struct Client {
  using Clock = std::chrono::steady_clock;

  Client(int descriptor, std::uint64_t number, std::string address, const HeadLimits& limits)
      : socket(descriptor), id(number), remote(std::move(address)), reader(limits) {}
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  Client(Client&&) = delete;
  Client& operator=(Client&&) = delete;

  enum class Read { more, drained, nothing_now, ended };  ///< drained: something, and nothing is left
  /// Appends what the socket has, at most one piece.
  Read receive();
  enum class Sent { all, some, failed };
  /// Sends of `output` what the socket takes now.
  Sent flush();
  /// Ends the sending side, so that a client that still sends reads the response instead of an aborted
  /// connection.
  void end_output() const;
  /// Whether there was something to discard and more may come.
  [[nodiscard]] Read discard() const;
  void close();
  /// What is in memory for this client, about.
  [[nodiscard]] std::size_t held_bytes() const;

  std::mutex mutex;
  int socket;
  const std::uint64_t id;
  const std::string remote;
  Phase phase = Phase::idle;
  Clock::time_point deadline;
  RequestReader reader;
  std::size_t counted = 0;  ///< of held_bytes(): what the listener has counted
  std::string output;
  std::size_t output_sent = 0;
  bool close_after = false;              ///< the response that is being sent is the last
  bool linger_after = false;             ///< and the client may still be sending
  bool head_only = false;                ///< the request was HEAD
  bool chunked = false;                  ///< how a body with a rest is sent
  std::shared_ptr<BodySource> rest;      ///< what follows `output`
  std::function<Response()> work;        ///< makes the response, in its turn
  std::size_t work_bytes = 0;            ///< that it keeps
  std::uint64_t deferral = 0;            ///< counts deferred responses
  std::shared_ptr<Outbox> outbox;        ///< of a stream
  std::shared_ptr<StreamSource> source;  ///< fills the outbox
};

}  // namespace snapthrough::server::http
