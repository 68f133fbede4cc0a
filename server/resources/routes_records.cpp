/// What owners used and did.

#include <array>
#include <utility>

#include "server/jobs/envelope.h"
#include "server/resources/documents.h"
#include "server/resources/negotiation.h"
#include "server/resources/records.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {
namespace {

/// Largest number of rows of usage in one response.
constexpr int kMostUsageRows = 10'000;
/// Time before the end of a query of usage without `from`.
constexpr std::chrono::hours kUsageSpan{30 * 24};

/// Valid parameters, for messages.
constexpr const char* kUsageQuery =
    "from and to (RFC 3339, e.g. 2026-01-31T08:30:00Z; hours that begin at from or later and before to), "
    "label,"
    " format (json, csv), each once";
constexpr const char* kAuditQuery =
    "from and to (RFC 3339, e.g. 2026-01-31T08:30:00Z), limit (1 to 1000), cursor (from a next link), each "
    "once";
static_assert(kLargestPage == 1000, "the message names it");

/// A query of usage as far as the request has it.
struct WantedUsage {
  std::optional<Time> from;
  std::optional<Time> to;
  std::optional<std::string> label;
  std::optional<std::string> format;
};

constexpr QueryParameter<WantedUsage> kUsageParameters[] = {
    {"from", [](const std::string& value,
                WantedUsage& query) { return (query.from = time_from(value)).has_value(); }},
    {"to",
     [](const std::string& value, WantedUsage& query) { return (query.to = time_from(value)).has_value(); }},
    {"label",
     [](const std::string& value, WantedUsage& query) {
       query.label = value;
       return characters(value) <= kLongestLabel;
     }},
    {"format", [](const std::string& value, WantedUsage& query) {
       query.format = value;
       return value == "json" || value == "csv";
     }}};

constexpr QueryParameter<AuditQuery> kAuditParameters[] = {
    {"from",
     [](const std::string& value, AuditQuery& query) { return (query.from = time_from(value)).has_value(); }},
    {"to",
     [](const std::string& value, AuditQuery& query) { return (query.to = time_from(value)).has_value(); }},
    {"cursor",
     [](const std::string& value, AuditQuery& query) {
       return (query.before = whole_number<std::int64_t>(value)).has_value();
     }},
    {"limit", [](const std::string& value, AuditQuery& query) {
       query.limit = whole_number<int>(value).value_or(0);
       return query.limit >= 1 && query.limit <= kLargestPage;
     }}};

bool wants_csv(const Request& request, const WantedUsage& wanted) {
  if (wanted.format) {
    return *wanted.format == "csv";
  }
  static constexpr std::array<std::string_view, 2> kTypes{"application/json", "text/csv"};
  return preferred_type(request.header("Accept").value_or("*/*"), kTypes) == std::optional<std::size_t>(1);
}

}  // namespace

Response Routes::usage(const Request& request, const std::string& /*id*/) {
  WantedUsage wanted;
  if (const auto wrong = read_query(request, kUsageParameters, wanted)) {
    return wrong_parameter(request, kUsageQuery, wrong->first, wrong->second);
  }
  const Time now = jobs_.environment().now();
  UsageQuery query{request.owner, {}, wanted.to.value_or(now), wanted.label, kMostUsageRows};
  query.from = wanted.from.value_or(query.to - kUsageSpan);
  const StatusOr<std::vector<UsageRow>> rows = jobs_.store().ledger().usage(query);
  const StatusOr<Balance> balance = jobs_.store().ledger().balance(request.owner, now);
  if (!rows.ok() || !balance.ok()) {
    return store_trouble(request, rows.ok() ? balance.status() : rows.status());
  }
  if (rows->size() > static_cast<std::size_t>(kMostUsageRows)) {
    return simple_problem(request, 400, "range-too-large", "Range too large",
                          "There are more than " + std::to_string(kMostUsageRows) +
                              " rows (hours and labels) between from and to: ask for less at a time.");
  }
  Response response = json_response(200, usage_document(query, *rows, jobs_.limits().quotas, *balance));
  if (wants_csv(request, wanted)) {
    response.body = usage_csv(*rows);
    response.content_type = "text/csv; charset=utf-8; header=present";
  }
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

Response Routes::audit(const Request& request, const std::string& /*id*/) {
  AuditQuery query;
  query.owner = request.owner;
  if (const auto wrong = read_query(request, kAuditParameters, query)) {
    return wrong_parameter(request, kAuditQuery, wrong->first, wrong->second);
  }
  StatusOr<std::vector<AuditEntry>> read = jobs_.store().ledger().events(query);
  if (!read.ok()) {
    return store_trouble(request, read.status());
  }
  std::vector<AuditEntry> entries = std::move(read).value();
  std::string next;
  if (entries.size() > static_cast<std::size_t>(query.limit)) {
    entries.pop_back();
    next = request.path + "?cursor=" + std::to_string(entries.back().number);
    for (const auto& [name, value] : request.query) {
      next += name == "cursor" ? "" : "&" + name + "=" + percent_encoded(value);
    }
  }
  return list_page(audit_document(request.owner, entries, next), next);
}

void Routes::tell_balance(const Request& request, Response& response) {
  const Quotas& quotas = jobs_.limits().quotas;
  if (!quotas.any()) {
    return;
  }
  if (response.deferred) {
    // The function's owner keeps the request alive (see Gateway).
    response.deferred->resume = [this, &request, resume = std::move(response.deferred->resume)] {
      Response late = resume();
      tell_balance(request, late);
      return late;
    };
    return;
  }
  const StatusOr<Balance> balance = jobs_.store().ledger().balance(request.owner, jobs_.environment().now());
  if (balance.ok()) {
    add_balance(quotas, *balance, response);
  }
}

Response Routes::told_of_deletion(const Request& request, const std::string& id, Response missing) {
  if (missing.status != 404) {
    return missing;
  }
  const StatusOr<std::optional<AuditEntry>> deletion = jobs_.store().ledger().deletion(id, request.owner);
  return deletion.ok() && deletion->has_value()
             ? simple_problem(request, 410, "deleted", "Deleted", deletion_sentence(**deletion))
             : std::move(missing);
}

}  // namespace snapthrough::server::http
