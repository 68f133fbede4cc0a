#pragma once
/// @file
/// The head of a request from its bytes: what it says, how much follows, and whether it is refused. Pure
/// functions; the only parser of requests.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Bounds on what a client may send.
struct HeadLimits {
  std::size_t head_bytes = 16 * 1024;  ///< request line and headers together
  std::size_t target_bytes = 2048;     ///< path and query
  std::size_t header_count = 100;
  std::size_t body_bytes = 8 * 1024 * 1024;
  /// Of all incomplete requests and responses that are being sent, together.
  std::size_t buffered_bytes = 64 * 1024 * 1024;
};

/// Why a request is refused before anything is asked.
struct Refusal {
  int status = 400;
  std::string detail;
};

/// The head of a request, and what it says about the bytes that follow.
struct Head {
  std::string method;
  std::string target;  ///< path and query as they came
  Fields headers;      ///< in order, their values without the blanks around
  std::size_t body_bytes = 0;
  bool chunked = false;            ///< the body comes in chunks: its size is not known yet
  bool keep_alive = false;         ///< the client may send another request on this connection
  bool takes_chunks = false;       ///< it speaks HTTP/1.1
  bool expects_continue = false;   ///< the client waits for "100 Continue" before it sends the body
  std::optional<Refusal> refusal;  ///< set: answer this and close the connection; the rest may be missing
};

/// @brief Reads the head of a request.
/// @param head request line and headers up to and including the empty line
[[nodiscard]] Head read_head(std::string_view head, const HeadLimits& limits);

/// Whether the service knows a method, be it to say that a resource has it not.
[[nodiscard]] bool is_known_method(std::string_view method);

}  // namespace snapthrough::server::http
