#pragma once
/// @file
/// Parser of request heads: content, size of the body, and refusal. Pure functions; the service has no other
/// parser of requests.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Limits of requests.
struct HeadLimits {
  std::size_t head_bytes = 16 * 1024;  ///< bytes of request line and headers
  std::size_t target_bytes = 2048;     ///< bytes of path and query
  std::size_t header_count = 100;
  std::size_t body_bytes = 8 * 1024 * 1024;
  /// Limit for all incomplete requests and unsent responses together.
  std::size_t buffered_bytes = 64 * 1024 * 1024;
};

/// Response to a request that is refused before routing.
struct Refusal {
  int status = 400;
  std::string detail;
};

/// The head of a request, and the form of its body.
struct Head {
  std::string method;
  std::string target;  ///< path and query, not decoded
  Fields headers;      ///< headers in order, values trimmed
  std::size_t body_bytes = 0;
  bool chunked = false;            ///< the body is chunked; its size is unknown
  bool keep_alive = false;         ///< the connection stays open for another request
  bool takes_chunks = false;       ///< the client uses HTTP/1.1
  bool expects_continue = false;   ///< the client waits for "100 Continue" before the body
  std::optional<Refusal> refusal;  ///< if set: send it and close the connection; other members may be unset
};

/// @brief Parses the head of a request.
/// @param head request line and headers up to and including the empty line
[[nodiscard]] Head read_head(std::string_view head, const HeadLimits& limits);

/// Returns whether the service knows a method, including methods that it answers only with a refusal.
[[nodiscard]] bool is_known_method(std::string_view method);

/// @brief Returns the request of a head, without body, id and peer.
/// @pre read_head() did not refuse the head
[[nodiscard]] Request request_of(Head head);

}  // namespace snapthrough::server::http
