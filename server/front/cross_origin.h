#pragma once
/// @file
/// Pages of other origins that may use the service (CORS, https://fetch.spec.whatwg.org/#http-cors-protocol).

#include <string>
#include <string_view>
#include <vector>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Whether a text is an origin as browsers send it: scheme "http" or "https", host in lower case, port if it
/// is not the scheme's own; nothing after it. "*" and "null" are none.
[[nodiscard]] bool is_origin(std::string_view text);

/// @brief The origins that are allowed, and what browsers have to be told for them. Thread-safe.
class CrossOrigin {
 public:
  /// @param allowed each is_origin()
  explicit CrossOrigin(std::vector<std::string> allowed = {}) : allowed_(std::move(allowed)) {}

  [[nodiscard]] bool allows(std::string_view origin) const;
  /// Whether a browser asks if a page of an allowed origin may send a request. It sends no key with that.
  [[nodiscard]] bool is_preflight(const Request& request) const;
  /// The response to a preflight. @param methods of the resource, as a list; not empty
  [[nodiscard]] static Response preflight(const std::string& methods);
  /// Headers that let an allowed page read a response, errors included. @param origin of the page; may be
  /// empty
  void mark(std::string_view origin, Response& response) const;

 private:
  std::vector<std::string> allowed_;
};

}  // namespace snapthrough::server::http
