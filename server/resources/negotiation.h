#pragma once
/// @file
/// What requests about jobs and about sweeps say in the same way, and how both are refused.

#include <charconv>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "api/sweep_table.h"
#include "server/jobs/submission.h"
#include "server/resources/message.h"
#include "server/store/list_query.h"

namespace snapthrough::server::http {

template <class Number>
[[nodiscard]] std::optional<Number> whole_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Most entries of one page of a list.
inline constexpr int kLargestPage = 1000;

/// @brief Reads the query parameters of a list, of jobs or of sweeps, into `query`.
/// @return the problem of the first that is unknown, repeated, or has no acceptable value; nothing when all
/// are good
[[nodiscard]] std::optional<Response> read_list_query(const Request& request, ListQuery& query);

/// The target of a list's next page, with the same filters; empty when there is none.
/// @param next where it begins
[[nodiscard]] std::string next_page(const Request& request, const std::optional<ListPlace>& next);

/// A page of a list; `next`, if not empty, is its Link.
[[nodiscard]] Response list_page(std::string document, const std::string& next);

/// A problem about the query parameter. @param expected which there are
[[nodiscard]] Response wrong_parameter(const Request& request, const std::string& expected,
                                       const std::string& name, const std::string& value);

/// @brief A stream of events from the one after Last-Event-ID on; 204 when that was the last one there is,
/// which tells an EventSource not to come back.
/// @param end id of the last event, if what is followed has ended
/// @param follow called with the id of the last event that was seen and the push function
[[nodiscard]] Response event_stream(
    const Request& request, std::optional<std::uint64_t> end,
    std::function<std::shared_ptr<StreamSource>(std::uint64_t, Stream::Push)> follow);

/// Whether a list of codings ("br;q=1.0, gzip;q=0.8") takes gzip.
[[nodiscard]] bool takes_gzip(std::string_view accepted);

/// Whether If-None-Match names the tag, or the one of the same bytes compressed.
[[nodiscard]] bool matches_etag(const Request& request, const std::string& etag);

/// Whether the client does not want what is stored already.
[[nodiscard]] bool wants_fresh(const Request& request);

/// The problem of an Idempotency-Key that is none; nothing when there is none, or a good one.
[[nodiscard]] std::optional<Response> refused_key(const Request& request);

/// The problem of a submission that left nothing in the store. @param what "jobs" or "sweeps"
[[nodiscard]] std::optional<Response> refusal_of(const Request& request, Submission& submission,
                                                 const char* what);

/// @brief The request as if its query asked for CSV, whatever it accepts; nothing when the query has a
/// format. Refers to nothing of the request.
[[nodiscard]] std::optional<Request> as_csv(const Request& request);

/// The form of a table that the client takes: by ?format= before Accept; JSON when any will do.
[[nodiscard]] std::optional<api::TableForm> wanted_table_form(const Request& request);

}  // namespace snapthrough::server::http
