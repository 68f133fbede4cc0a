#pragma once
/// @file
/// Use of the service by pages of other origins (CORS, https://fetch.spec.whatwg.org/#http-cors-protocol).

#include <string>
#include <string_view>
#include <vector>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Returns whether a text is an origin as browsers send it: scheme http or https, host in lower case, port
/// unless it is the scheme's default, nothing more. "*" and "null" are not origins.
[[nodiscard]] bool is_origin(std::string_view text);

/// @brief The allowed origins and their response headers. Thread-safe.
class CrossOrigin {
 public:
  /// @param allowed texts for which is_origin() is true
  explicit CrossOrigin(std::vector<std::string> allowed = {}) : allowed_(std::move(allowed)) {}

  [[nodiscard]] bool allows(std::string_view origin) const;
  /// Returns whether a request is a preflight from an allowed origin. Browsers send preflights without a key.
  [[nodiscard]] bool is_preflight(const Request& request) const;
  /// Returns the response to a preflight. @param methods methods of the resource, as a list; not empty
  [[nodiscard]] static Response preflight(const std::string& methods);
  /// Adds the headers that let an allowed page read a response, also an error. @param origin origin of the
  /// page; may be empty
  void mark(std::string_view origin, Response& response) const;

 private:
  std::vector<std::string> allowed_;
};

}  // namespace snapthrough::server::http
