#pragma once
/// @file
/// Requests and responses as the service sees them, whatever library carries them. Plain data.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace snapthrough::server::http {

using Fields = std::vector<std::pair<std::string, std::string>>;

/// A complete request. Names of headers are compared without regard to case.
struct Request {
  std::string method;
  std::string path;  ///< percent-decoded, without the query
  Fields query;      ///< decoded, in order
  Fields headers;    ///< in order
  std::string body;
  std::string id;      ///< identifies the request in logs and problems
  std::string remote;  ///< address of the peer

  /// The first header of that name, or nothing.
  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
};

struct Response {
  int status = 200;
  Fields headers;  ///< without Content-Type and Content-Length
  std::string content_type;
  std::string body;
  std::string trouble;  ///< what went wrong inside, for the log only
  std::string route;    ///< template of the matched route for logs, e.g. "/v1/jobs/{id}"; empty: none
};

/// Whether two ASCII texts are equal without regard to case.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// The text without spaces and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The parts between the separators, trimmed, empty ones left out.
[[nodiscard]] std::vector<std::string_view> split_list(std::string_view text, char separator);

}  // namespace snapthrough::server::http
