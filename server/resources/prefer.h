#pragma once
/// @file
/// The Prefer header (RFC 7240), as far as jobs use it.

#include <optional>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// What the client would like. Preferences that are unknown or malformed are ignored, as the RFC asks.
struct Preferences {
  bool respond_async = false;
  std::optional<int> wait_s;  ///< seconds, >= 0
};

/// Reads every Prefer header of a request.
[[nodiscard]] Preferences read_preferences(const Request& request);

}  // namespace snapthrough::server::http
