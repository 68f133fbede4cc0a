#pragma once
/// @file
/// Orders (documents that clients hand in), and what becomes of them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/digest.h"
#include "server/jobs/job.h"
#include "server/status.h"
#include "solver/check/check.h"

namespace snapthrough::server {

/// A request or sweep document with the wishes of the client.
struct Order {
  std::string_view document;         ///< a document or an envelope (jobs/envelope.h)
  std::string_view request_id = {};  ///< identifies the HTTP request in the log
  std::string owner = {};            ///< see Job
  std::optional<std::string_view> idempotency_key =
      {};              ///< a later order with the same key and document is this one
  bool waits = false;  ///< the client waits for the outcome
  bool reuse = true;   ///< a stored result of the same content may be used
};

/// Outcome of an order.
struct Submission {
  enum class Kind {
    stored,        ///< `id` is a new job or sweep
    repeated,      ///< `id` is the job or sweep of an earlier order with the same key
    reused,        ///< `id` is a successful job with the same content
    copied,        ///< `id` is a new successful job with the result of a job with the same content
    malformed,     ///< the document is no JSON, see findings; nothing was stored
    invalid,       ///< see findings; nothing was stored
    key_conflict,  ///< the key was used with another document
    key_in_use,    ///< another order with this key is being served at the moment
    queue_full
  } kind = Kind::stored;
  std::vector<Finding> findings = {};
  std::string id = {};
};

/// The idempotency key of an order with the fingerprint of its document, or nothing.
[[nodiscard]] inline std::optional<IdempotencyKey> key_of(const Order& order) {
  if (!order.idempotency_key) {
    return std::nullopt;
  }
  return IdempotencyKey{std::string(*order.idempotency_key), sha256_hex(order.document)};
}

/// @brief Outcome of an order while the queue is full: the job or sweep of its idempotency key, or
/// `queue_full`.
/// @tparam AnyStore Store or SweepStore
template <class AnyStore>
StatusOr<Submission> known_or_full(AnyStore& store, const Order& order) {
  if (const std::optional<IdempotencyKey> key = key_of(order)) {
    const StatusOr<std::optional<Submitted>> known = store.find_key(*key, order.owner);
    if (!known.ok()) {
      return known.status();
    }
    if (known->has_value()) {
      const bool repeated = (*known)->kind == Submitted::Kind::repeated;
      return Submission{
          repeated ? Submission::Kind::repeated : Submission::Kind::key_conflict, {}, (*known)->id};
    }
  }
  return Submission{Submission::Kind::queue_full};
}

}  // namespace snapthrough::server
