#pragma once
/// @file
/// State of one client's connection to the listener.

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

/// Interim response: the request goes on.
inline constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

/// What a connection waits for.
enum class Phase {
  idle,       ///< first byte of a request
  head,       ///< rest of a head
  body,       ///< rest of a body
  in_row,     ///< its turn to compute the response
  deferred,   ///< the event that completes a deferred response
  sending,    ///< the client, to receive the response
  streaming,  ///< events to send
  lingering,  ///< the client, to read the refusal and close
  closed
};

/// Pieces of a stream that wait to be sent. Thread-safe.
class Outbox {
 public:
  /// Adds a piece. Returns false when the client is gone or so slow that too much waits, or when there is no
  /// memory for the piece.
  bool put(const std::string& piece, bool last);
  /// Returns the waiting pieces; sets `last` when no piece follows.
  std::string take(bool& last);
  /// Rejects all further pieces.
  void close();
  /// Returns whether the outbox is closed, by close() or because too much was waiting.
  [[nodiscard]] bool closed();

 private:
  std::mutex mutex_;
  std::string waiting_;
  bool last_ = false;
  bool closed_ = false;
};

/// @brief A connection. A caller must hold `mutex`; the functions do not lock.
struct Client {
  using Clock = std::chrono::steady_clock;

  Client(int descriptor, std::uint64_t number, std::string address, const HeadLimits& limits)
      : socket(descriptor),
        id(number),
        remote(std::move(address)),
        party("address " + remote),
        reader(limits) {}
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  Client(Client&&) = delete;
  Client& operator=(Client&&) = delete;

  enum class Read { more, drained, nothing_now, ended };  ///< drained: bytes were read, none are left
  /// Appends bytes of the socket to the reader, at most 16 KiB.
  Read receive();
  enum class Sent { all, some, failed };
  /// Sends as much of `output` as the socket accepts.
  Sent flush();
  /// Shuts the sending side down, so that a client that still sends can read the response before the
  /// connection closes.
  void end_output() const;
  /// Reads and discards bytes. Returns `more` if any were read, `ended` at the end of the connection.
  [[nodiscard]] Read discard() const;
  void close();
  /// @brief Returns whether the client has closed the connection, so that nobody waits for the response.
  ///
  /// A client that has only ended its sending side (shutdown with SHUT_WR) waits. Both look the same until
  /// something is sent; see ask_whether_it_waits(), which the first call after the end of the side calls.
  bool is_gone();
  /// @brief Sends an interim response, once, when nothing else is under way.
  ///
  /// The system of a client that has closed the connection resets it then, which is_gone() and an event of
  /// epoll (EPOLLERR, EPOLLHUP) tell. Clients of HTTP/1.0 know no interim responses and are not asked.
  void ask_whether_it_waits();
  /// Returns whether bytes of the client, or the end of its side, wait to be read.
  [[nodiscard]] bool has_arrived() const;
  /// Returns the approximate memory of the client in bytes.
  [[nodiscard]] std::size_t held_bytes() const;

  std::mutex mutex;
  int socket;
  const std::uint64_t id;
  const std::string remote;
  std::string party;       ///< who asks, see Caller::party; the address until a head tells more
  bool gives_way = false;  ///< the lane of low priority watches the socket
  Phase phase = Phase::idle;
  Clock::time_point deadline;
  RequestReader reader;
  std::size_t counted = 0;  ///< part of held_bytes() that the listener has counted
  std::string output;
  std::size_t output_sent = 0;
  bool close_after = false;              ///< close the connection after the response
  bool linger_after = false;             ///< wait for the client before closing
  bool head_only = false;                ///< the request was HEAD: send no body
  bool chunked = false;                  ///< HTTP/1.1: send a body with `rest` in chunks
  bool asked = false;                    ///< the client was asked whether it waits
  std::atomic<bool> working = false;     ///< a thread computes the response
  std::shared_ptr<BodySource> rest;      ///< rest of the body after `output`
  std::function<Response()> work;        ///< computes the response in its turn
  std::size_t work_bytes = 0;            ///< memory in use by `work`
  std::uint64_t deferral = 0;            ///< counts deferred responses
  std::shared_ptr<Outbox> outbox;        ///< pieces of the stream that wait
  std::shared_ptr<StreamSource> source;  ///< fills the outbox
};

}  // namespace snapthrough::server::http
