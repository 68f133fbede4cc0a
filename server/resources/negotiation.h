#pragma once
/// @file
/// Headers, query parameters and refusals that requests about jobs and sweeps share.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

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

/// Reads `true` or `false` into `flag`; returns whether the value is one of them.
[[nodiscard]] inline bool read_flag(std::string_view value, bool& flag) {
  flag = value == "true";
  return flag || value == "false";
}

/// A query parameter that sets a part of `Query`.
template <class Query>
struct QueryParameter {
  std::string_view name;
  bool (*read)(const std::string& value, Query& query);  ///< returns false for an invalid value
  bool repeats = false;                                  ///< may be given more than once
};

/// @brief Reads the query parameters of a request into `query`.
/// @return name and value of the first one that is unknown, repeated or invalid; nullopt when all are valid
template <class Query, std::size_t n>
[[nodiscard]] std::optional<std::pair<std::string, std::string>> read_query(
    const Request& request, const QueryParameter<Query> (&parameters)[n], Query& query) {
  std::set<std::string_view> seen;
  for (const auto& given : request.query) {
    const auto* const known =
        std::find_if(std::begin(parameters), std::end(parameters),
                     [&given](const QueryParameter<Query>& one) { return one.name == given.first; });
    if (known == std::end(parameters) || (!seen.insert(given.first).second && !known->repeats) ||
        !known->read(given.second, query)) {
      return given;
    }
  }
  return std::nullopt;
}

/// Largest number of entries on a page of a list.
inline constexpr int kLargestPage = 1000;

/// @brief Reads the query parameters of a list of jobs or sweeps into `query`.
/// @return a problem about the first parameter that is unknown, repeated or invalid; nullopt when all are
/// valid
[[nodiscard]] std::optional<Response> read_list_query(const Request& request, ListQuery& query);

/// Returns the target of the next page of a list with the same filters; "" when there is none.
/// @param next first entry of the next page
[[nodiscard]] std::string next_page(const Request& request, const std::optional<ListPlace>& next);

/// Returns a page of a list; `next` becomes its Link header unless empty.
[[nodiscard]] Response list_page(std::string document, const std::string& next);

/// Returns a problem about a query parameter. @param expected the valid parameters
[[nodiscard]] Response wrong_parameter(const Request& request, const std::string& expected,
                                       const std::string& name, const std::string& value);

/// @brief Returns a stream of the events after Last-Event-ID; 204 when that is the last event, after which an
/// EventSource does not reconnect.
/// @param end id of the last event, if the job or sweep has ended
/// @param follow called with the last received id and the push function
[[nodiscard]] Response event_stream(
    const Request& request, std::optional<std::uint64_t> end,
    std::function<std::shared_ptr<StreamSource>(std::uint64_t, Stream::Push)> follow);

/// Returns whether a Content-Type is JSON.
[[nodiscard]] bool is_json(std::string_view content_type);

/// Returns whether a list of codings ("br;q=1.0, gzip;q=0.8") accepts gzip.
[[nodiscard]] bool takes_gzip(std::string_view accepted);

/// Returns whether If-None-Match contains the tag, or the tag of the compressed body.
[[nodiscard]] bool matches_etag(const Request& request, const std::string& etag);

/// Returns whether the client rejects stored results (Cache-Control: no-cache).
[[nodiscard]] bool wants_fresh(const Request& request);

/// Returns a problem about an invalid Idempotency-Key; nullopt without key or for a valid one.
[[nodiscard]] std::optional<Response> refused_key(const Request& request);

/// Returns the problem of a submission that was not stored. @param what "jobs" or "sweeps"
[[nodiscard]] std::optional<Response> refusal_of(const Request& request, Submission& submission,
                                                 const char* what);

/// @brief Returns a copy of the request that asks for CSV, whatever it accepts; nullopt when its query has
/// `format`.
[[nodiscard]] std::optional<Request> as_csv(const Request& request);

/// @brief Returns the index of the offered media type that an Accept header weighs highest, the first of
/// equal ones; nullopt when it accepts none. The most specific range that a type is in has its weight (RFC
/// 9110, 12.5.1).
[[nodiscard]] std::optional<std::size_t> preferred_type(std::string_view accept,
                                                        std::span<const std::string_view> offered);

/// Returns the table form that the client accepts (?format= before Accept); JSON when it accepts any.
[[nodiscard]] std::optional<api::TableForm> wanted_table_form(const Request& request);

}  // namespace snapthrough::server::http
