#pragma once
/// @file
/// The only place that sees the HTTP library: it parses request lines, headers and queries.

#include <memory>
#include <optional>
#include <string>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// @brief Parses the heads of requests. Thread-safe.
class RequestParser {
 public:
  RequestParser();
  ~RequestParser();
  RequestParser(const RequestParser&) = delete;
  RequestParser& operator=(const RequestParser&) = delete;
  RequestParser(RequestParser&&) = delete;
  RequestParser& operator=(RequestParser&&) = delete;

  /// @param head request line and headers up to and including the empty line, from cleaned_head()
  /// @return the request without body, id and peer; nothing when the library does not take it
  [[nodiscard]] std::optional<Request> parse(const std::string& head) const;

 private:
  class Library;
  std::unique_ptr<Library> library_;
};

}  // namespace snapthrough::server::http
