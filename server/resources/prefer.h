#pragma once
/// @file
/// The Prefer header (RFC 7240), as far as jobs use it.

#include <optional>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Preferred content of the response.
enum class ReturnPreference { minimal, representation };

/// Preferences of the client. Unknown or malformed ones are ignored; of several with one name, the first
/// counts (RFC 7240).
struct Preferences {
  bool respond_async = false;
  std::optional<int> wait_s;                     ///< preferred longest wait in seconds, >= 0
  std::optional<ReturnPreference> return_shape;  ///< preference `return`

  /// Returns whether the response must be a job, even if its result is known.
  [[nodiscard]] bool wants_job() const { return respond_async || return_shape == ReturnPreference::minimal; }
};

/// Reads all Prefer headers of a request.
[[nodiscard]] Preferences read_preferences(const Request& request);

}  // namespace snapthrough::server::http
