#pragma once
/// @file
/// The Prefer header (RFC 7240), as far as jobs use it.

#include <optional>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// What a client wants to be answered with.
enum class ReturnPreference { minimal, representation };

/// What the client would like. Preferences that are unknown or malformed are ignored, and of several of one
/// name the first counts, as the RFC asks.
struct Preferences {
  bool respond_async = false;
  std::optional<int> wait_s;                     ///< seconds, >= 0
  std::optional<ReturnPreference> return_shape;  ///< return=minimal, return=representation

  /// Whether a job is wanted, whatever is known of its result.
  [[nodiscard]] bool wants_job() const { return respond_async || return_shape == ReturnPreference::minimal; }
};

/// Reads every Prefer header of a request.
[[nodiscard]] Preferences read_preferences(const Request& request);

}  // namespace snapthrough::server::http
