#pragma once
/// @file
/// Documents that are handed in, and what becomes of them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/check/check.h"

namespace snapthrough::server {

/// A request or sweep document and how it was handed in.
struct Order {
  std::string_view document;                             ///< by itself or in an envelope (jobs/envelope.h)
  std::string_view request_id = {};                      ///< for the log
  std::string owner = {};                                ///< see Job
  std::optional<std::string_view> idempotency_key = {};  ///< a second order with it is the first
  bool waits = false;                                    ///< the caller waits for the outcome
  bool reuse = true;                                     ///< what is stored of the same content will do
};

/// What became of an order.
struct Submission {
  enum class Kind {
    stored,        ///< `id` is a new job or sweep
    repeated,      ///< `id` is that of the same idempotency key
    reused,        ///< `id` is a successful job of the same content
    copied,        ///< `id` is a new, successful job with the result of one of the same content
    malformed,     ///< not a JSON document, see findings; nothing was stored
    invalid,       ///< see findings; nothing was stored
    key_conflict,  ///< the idempotency key came with another document before
    key_in_use,    ///< a request with this idempotency key is being served at this moment
    queue_full
  } kind = Kind::stored;
  std::vector<Finding> findings = {};
  std::string id = {};
};

}  // namespace snapthrough::server
