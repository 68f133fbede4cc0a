#pragma once
/// @file
/// Orders that were handed in before, with their idempotency key.

#include <optional>
#include <string>

#include "server/digest.h"
#include "server/jobs/job.h"
#include "server/jobs/submission.h"
#include "server/status.h"

namespace snapthrough::server {

[[nodiscard]] inline std::optional<IdempotencyKey> key_of(const Order& order) {
  if (!order.idempotency_key) {
    return std::nullopt;
  }
  return IdempotencyKey{std::string(*order.idempotency_key), sha256_hex(order.document)};
}

/// @brief What an order is where nothing new is taken: the one that its key was used for, or refused.
/// @tparam AnyStore a Store or SweepStore
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
