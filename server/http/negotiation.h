#pragma once
/// @file
/// What requests about jobs and about sweeps say in the same way, and how both are refused.

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "api/sweep_table.h"
#include "server/http/message.h"
#include "server/jobs/submission.h"

namespace snapthrough::server::http {

template <class Number>
[[nodiscard]] std::optional<Number> whole_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Whether If-None-Match names the tag, or the one of the same bytes compressed.
[[nodiscard]] bool matches_etag(const Request& request, const std::string& etag);

/// Whether the client does not want what is stored already.
[[nodiscard]] bool wants_fresh(const Request& request);

/// The problem of an Idempotency-Key that is none; nothing when there is none, or a good one.
[[nodiscard]] std::optional<Response> refused_key(const Request& request);

/// The problem of a submission that left nothing in the store. @param what "jobs" or "sweeps"
[[nodiscard]] std::optional<Response> refusal_of(const Request& request, Submission& submission,
                                                 const char* what);

/// The form of a table that the client takes: by ?format= before Accept; JSON when any will do.
[[nodiscard]] std::optional<api::TableForm> wanted_table_form(const Request& request);

}  // namespace snapthrough::server::http
