#include "server/resources/negotiation.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "api/names.h"
#include "server/jobs/envelope.h"
#include "server/resources/documents.h"

namespace snapthrough::server::http {
namespace {

constexpr std::size_t kLongestKey = 255;

bool is_key(std::string_view text) {
  return !text.empty() && text.size() <= kLongestKey &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > 0x20 && c < 0x7F; });
}

Response refused_document(const Request& request, Submission submission) {
  Problem problem{422, "invalid-request", "Invalid request", "", std::move(submission.findings), "", ""};
  if (submission.kind == Submission::Kind::malformed) {
    problem = {400, "malformed-json", "Malformed JSON", "", std::move(problem.errors), "", ""};
  }
  const std::size_t count = problem.errors.size();
  problem.detail = "The document has " + std::to_string(count) + (count == 1 ? " error" : " errors") +
                   "; nothing was stored.";
  return problem_response(problem, request);
}

/// Returns the weight (";q=0.5") of an element of a list; 1 without one.
double weight_of(std::string_view part) {
  const std::size_t semicolon = part.find(';');
  const std::size_t quality = semicolon == part.npos ? part.npos : part.find("q=", semicolon);
  double weight = 1.0;
  if (quality != part.npos) {
    std::from_chars(part.data() + quality + 2, part.data() + part.size(), weight);
  }
  return weight;
}

/// Returns the cursor of a place in a list: "<microseconds>.<number>".
std::string cursor_of(const ListPlace& place) {
  return std::to_string(place.created.time_since_epoch().count()) + "." + std::to_string(place.number);
}

std::optional<ListPlace> place_of(std::string_view cursor) {
  const std::size_t point = cursor.find('.');
  const auto time = whole_number<std::int64_t>(cursor.substr(0, point));
  const auto number = whole_number<std::int64_t>(point == cursor.npos ? "" : cursor.substr(point + 1));
  return time && number ? std::optional(ListPlace{Time(std::chrono::microseconds(*time)), *number})
                        : std::nullopt;
}

constexpr QueryParameter<ListQuery> kListParameters[] = {
    {"limit",
     [](const std::string& value, ListQuery& query) {
       query.limit = whole_number<int>(value).value_or(0);
       return query.limit >= 1 && query.limit <= kLargestPage;
     }},
    {"cursor",
     [](const std::string& value, ListQuery& query) { return (query.before = place_of(value)).has_value(); }},
    {"status", [](const std::string& value,
                  ListQuery& query) { return (query.state = job_state_from(value)).has_value(); }},
    {"analysis",
     [](const std::string& value, ListQuery& query) {
       query.analysis = value;
       return api::value_of(api::kAnalysisTypes, value).has_value();
     }},
    {"label",
     [](const std::string& value, ListQuery& query) {
       query.label = value;
       return !value.empty() && characters(value) <= kLongestLabel;
     }},
    {"created_after", [](const std::string& value,
                         ListQuery& query) { return (query.created_after = time_from(value)).has_value(); }},
    {"created_before",
     [](const std::string& value, ListQuery& query) {
       return (query.created_before = time_from(value)).has_value();
     }},
};

}  // namespace

std::optional<Response> read_list_query(const Request& request, ListQuery& query) {
  if (const auto wrong = read_query(request, kListParameters, query)) {
    return wrong_parameter(
        request,
        "limit (1 to " + std::to_string(kLargestPage) + "), cursor (from a next link), status, analysis (" +
            api::names_in(api::kAnalysisTypes) + "), label (1 to " + std::to_string(kLongestLabel) +
            " characters), created_after and created_before (RFC 3339, e.g. "
            "2026-01-31T08:30:00Z), each once",
        wrong->first, wrong->second);
  }
  return std::nullopt;
}

std::string next_page(const Request& request, const std::optional<ListPlace>& next) {
  if (!next) {
    return "";
  }
  std::string target = request.path + "?cursor=" + cursor_of(*next);
  for (const auto& [name, value] : request.query) {
    target += name == "cursor" ? "" : "&" + name + "=" + percent_encoded(value);
  }
  return target;
}

Response list_page(std::string document, const std::string& next) {
  Response response = json_response(200, std::move(document));
  if (!next.empty()) {
    response.headers.emplace_back("Link", "<" + next + ">; rel=\"next\"");
  }
  return response;
}

Response wrong_parameter(const Request& request, const std::string& expected, const std::string& name,
                         const std::string& value) {
  return simple_problem(
      request, 400, "invalid-parameter", "Invalid parameter",
      "The query parameters are " + expected + "; this is none of them: " + name + "=" + value);
}

Response event_stream(const Request& request, std::optional<std::uint64_t> end,
                      std::function<std::shared_ptr<StreamSource>(std::uint64_t, Stream::Push)> follow) {
  Response response;
  response.headers.emplace_back("Cache-Control", "no-store");
  const std::uint64_t last =
      whole_number<std::uint64_t>(request.header("Last-Event-ID").value_or("")).value_or(0);
  if (end && last >= *end) {
    response.status = 204;
    return response;
  }
  response.content_type = "text/event-stream";
  response.stream =
      Stream{[follow = std::move(follow), last](Stream::Push push) { return follow(last, std::move(push)); }};
  return response;
}

bool is_json(std::string_view content_type) {
  return equal_ignoring_case(trimmed(content_type.substr(0, content_type.find(';'))), "application/json");
}

bool takes_gzip(std::string_view accepted) {
  bool any = false;
  for (const std::string_view part : split_list(accepted, ',')) {
    const std::size_t semicolon = part.find(';');
    const std::string_view coding = trimmed(part.substr(0, semicolon));
    const bool named = equal_ignoring_case(coding, "gzip");
    if (!named && coding != "*") {
      continue;
    }
    const double weight = weight_of(part);
    if (named) {
      return weight > 0.0;
    }
    any = weight > 0.0;
  }
  return any;
}

bool matches_etag(const Request& request, const std::string& etag) {
  const std::optional<std::string_view> header = request.header("If-None-Match");
  if (!header) {
    return false;
  }
  const std::string packed = etag.substr(0, etag.size() - 1) + "-gzip\"";
  const std::vector<std::string_view> tags = split_list(*header, ',');
  return std::any_of(tags.begin(), tags.end(), [&](std::string_view tag) {
    const std::string_view strong = tag.starts_with("W/") ? tag.substr(2) : tag;
    return strong == "*" || strong == etag || strong == packed;
  });
}

bool wants_fresh(const Request& request) {
  const std::vector<std::string_view> parts = split_list(request.header("Cache-Control").value_or(""), ',');
  return std::any_of(parts.begin(), parts.end(),
                     [](std::string_view part) { return equal_ignoring_case(part, "no-cache"); });
}

std::optional<Response> refused_key(const Request& request) {
  const std::optional<std::string_view> key = request.header("Idempotency-Key");
  if (!key || is_key(*key)) {
    return std::nullopt;
  }
  return simple_problem(request, 400, "invalid-header", "Invalid header",
                        "An Idempotency-Key has 1 to 255 visible ASCII characters.");
}

std::optional<Response> refusal_of(const Request& request, Submission& submission, const char* what) {
  switch (submission.kind) {
    case Submission::Kind::malformed:
    case Submission::Kind::invalid:
      return refused_document(request, std::move(submission));
    case Submission::Kind::key_conflict:
      return simple_problem(request, 422, "idempotency-key-reused", "Idempotency key reused",
                            "This Idempotency-Key came with another document before.");
    case Submission::Kind::key_in_use: {
      Response response =
          simple_problem(request, 409, "idempotency-key-in-use", "Idempotency key in use",
                         "A request with this Idempotency-Key is being served at this moment.");
      response.headers.emplace_back("Retry-After", "1");
      return response;
    }
    case Submission::Kind::queue_full: {
      Response response =
          simple_problem(request, 429, "queue-full", "Queue full",
                         "As many " + std::string(what) + " wait as the service takes (see /v1/limits).");
      response.headers.emplace_back("Retry-After", "10");
      return response;
    }
    case Submission::Kind::stored:
    case Submission::Kind::repeated:
    case Submission::Kind::reused:
    case Submission::Kind::copied:
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Request> as_csv(const Request& request) {
  const bool named = std::any_of(request.query.begin(), request.query.end(),
                                 [](const auto& one) { return one.first == "format"; });
  if (named) {
    return std::nullopt;
  }
  Request csv = request;
  csv.query.emplace_back("format", "csv");
  return csv;
}

std::optional<std::size_t> preferred_type(std::string_view accept,
                                          std::span<const std::string_view> offered) {
  std::vector<double> weights(offered.size(), 0.0);
  std::vector<int> specific(offered.size(), -1);
  for (const std::string_view part : split_list(accept, ',')) {
    const std::string_view range = trimmed(part.substr(0, part.find(';')));
    for (std::size_t i = 0; i < offered.size(); ++i) {
      const std::string_view family = offered[i].substr(0, offered[i].find('/') + 1);
      const int how = equal_ignoring_case(range, offered[i])                  ? 2
                      : equal_ignoring_case(range, std::string(family) + "*") ? 1
                      : range == "*/*"                                        ? 0
                                                                              : -1;
      if (how > specific[i]) {
        specific[i] = how;
        weights[i] = weight_of(part);
      }
    }
  }
  const auto best = std::max_element(weights.begin(), weights.end());
  return best != weights.end() && *best > 0.0
             ? std::optional(static_cast<std::size_t>(best - weights.begin()))
             : std::nullopt;
}

std::optional<api::TableForm> wanted_table_form(const Request& request) {
  for (const auto& [name, value] : request.query) {
    if (name == "format") {
      return api::table_form_from(value);
    }
  }
  const std::optional<std::string_view> accept = request.header("Accept");
  if (!accept || trimmed(*accept).empty()) {
    return api::TableForm::json;
  }
  static constexpr std::array<std::string_view, 5> kTypes{
      "application/json", "text/csv", "application/x-ndjson", "application/ndjson", "application/jsonl"};
  static constexpr std::array kForms{api::TableForm::json, api::TableForm::csv, api::TableForm::ndjson,
                                     api::TableForm::ndjson, api::TableForm::ndjson};
  const std::optional<std::size_t> best = preferred_type(*accept, kTypes);
  return best ? std::optional(kForms[*best]) : std::nullopt;
}

}  // namespace snapthrough::server::http
