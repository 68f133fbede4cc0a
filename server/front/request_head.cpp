#include "server/front/request_head.h"

#include <httplib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

namespace snapthrough::server::http {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

/// Removes the first line from the text and returns it without its end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find(kLineEnd);
  if (end == std::string_view::npos) {
    return std::exchange(text, {});
  }
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + kLineEnd.size());
  return line;
}

Head refuse(Head head, int status, std::string detail) {
  head.refusal = Refusal{status, std::move(detail)};
  return head;
}

/// Headers that determine body and connection, before validation.
struct Facts {
  std::optional<std::string_view> content_length;
  bool two_lengths = false;
  std::optional<std::string_view> transfer_encoding;
  bool two_encodings = false;
  bool content_encoding = false;
  bool expects_continue = false;
  bool close = false;
  bool keep_alive = false;
  int hosts = 0;
};

bool lists(std::string_view value, std::string_view word) {
  const std::vector<std::string_view> parts = split_list(value, ',');
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return equal_ignoring_case(part, word); });
}

/// Control characters can make two parsers see different requests (request smuggling).
bool has_control(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F; });
}

void note_header(std::string_view name, std::string_view value, Facts& facts) {
  if (equal_ignoring_case(name, "Content-Length")) {
    facts.two_lengths = facts.content_length.has_value();
    facts.content_length = value;
  } else if (equal_ignoring_case(name, "Transfer-Encoding")) {
    facts.two_encodings |= facts.transfer_encoding.has_value();
    facts.transfer_encoding = value;
  } else if (equal_ignoring_case(name, "Content-Encoding")) {
    facts.content_encoding = !equal_ignoring_case(value, "identity");
  } else if (equal_ignoring_case(name, "Expect")) {
    facts.expects_continue = equal_ignoring_case(value, "100-continue");
  } else if (equal_ignoring_case(name, "Connection")) {
    facts.close |= lists(value, "close");
    facts.keep_alive |= lists(value, "keep-alive");
  } else if (equal_ignoring_case(name, "Host")) {
    ++facts.hosts;
  }
}

Facts facts_of(const Fields& headers) {
  Facts facts;
  for (const auto& [name, value] : headers) {
    note_header(name, value, facts);
  }
  return facts;
}

/// Returns the headers; nullopt when a line is not a header.
std::optional<Fields> read_headers(std::string_view lines) {
  Fields headers;
  while (!lines.empty()) {
    const std::string_view line = take_line(lines);
    if (line.empty()) {
      break;
    }
    const std::size_t colon = line.find(':');
    const std::string_view name = line.substr(0, colon);
    // A space in or before a name lets headers pass one of two parsers (request smuggling).
    if (colon == std::string_view::npos || name.empty() || name.find_first_of(" \t") != name.npos ||
        has_control(line)) {
      return std::nullopt;
    }
    headers.emplace_back(name, trimmed(line.substr(colon + 1)));
  }
  return headers;
}

std::optional<std::size_t> length_of(std::string_view digits) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    return static_cast<std::size_t>(-1);
  }
  const bool whole = error == std::errc() && end == digits.data() + digits.size();
  return whole ? std::optional(value) : std::nullopt;
}

/// Returns path and query of a target in absolute form (with scheme and host); other targets unchanged.
std::string_view origin_form(std::string_view target) {
  constexpr std::string_view kScheme = "http://";
  if (target.size() < kScheme.size() || !equal_ignoring_case(target.substr(0, kScheme.size()), kScheme)) {
    return target;
  }
  const std::size_t path = target.find('/', kScheme.size());
  return path == std::string_view::npos ? std::string_view("/") : target.substr(path);
}

bool read_request_line(std::string_view line, Head& head) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string_view::npos || first == last || has_control(line)) {
    return false;
  }
  const std::string_view version = line.substr(last + 1);
  head.method = line.substr(0, first);
  head.target = origin_form(line.substr(first + 1, last - first - 1));
  head.takes_chunks = version == "HTTP/1.1";
  head.keep_alive = head.takes_chunks;  // default; a header may change it
  return (head.takes_chunks || version == "HTTP/1.0") && !head.target.empty() &&
         head.target.find_first_of(" #") == std::string::npos;
}

Head judge(Head head, const HeadLimits& limits) {
  if (!is_known_method(head.method)) {
    return refuse(std::move(head), 501, "This method is not known here.");
  }
  if (head.target.size() > limits.target_bytes) {
    return refuse(std::move(head), 414,
                  "The path and query may have " + std::to_string(limits.target_bytes) + " bytes.");
  }
  if (head.headers.size() > limits.header_count) {
    return refuse(std::move(head), 431,
                  "A request may have " + std::to_string(limits.header_count) + " headers.");
  }
  const Facts facts = facts_of(head.headers);
  if (facts.two_lengths || facts.hosts > 1) {
    return refuse(std::move(head), 400, "The headers are malformed.");
  }
  if (facts.hosts == 0 && head.keep_alive) {
    return refuse(std::move(head), 400, "A request of HTTP/1.1 needs a Host.");
  }
  if (facts.transfer_encoding) {
    // Content-Length with chunks, or chunks in HTTP/1.0, allow request smuggling between two parsers.
    if (facts.content_length || facts.two_encodings || !head.takes_chunks) {
      return refuse(std::move(head), 400, "A body has either a Content-Length or, in HTTP/1.1, chunks.");
    }
    if (!equal_ignoring_case(*facts.transfer_encoding, "chunked")) {
      return refuse(std::move(head), 400, "The only Transfer-Encoding that is known here is chunked.");
    }
    head.chunked = true;
  }
  const bool has_body = head.method == "POST" || head.method == "PUT" || head.method == "PATCH";
  if (has_body && !facts.content_length && !head.chunked) {
    return refuse(std::move(head), 411, "A request body needs a Content-Length or chunks.");
  }
  if (facts.content_encoding) {
    return refuse(std::move(head), 415, "A request body is not compressed here.");
  }
  const std::optional<std::size_t> length = length_of(facts.content_length.value_or("0"));
  if (!length) {
    return refuse(std::move(head), 400, "The Content-Length is no number.");
  }
  if (*length > limits.body_bytes) {
    return refuse(std::move(head), 413,
                  "A request body may have " + std::to_string(limits.body_bytes) + " bytes.");
  }
  head.body_bytes = *length;
  head.keep_alive = !facts.close && (head.keep_alive || facts.keep_alive);
  head.expects_continue = facts.expects_continue && (*length > 0 || head.chunked);
  return head;
}

}  // namespace

bool is_known_method(std::string_view method) {
  static constexpr std::array<std::string_view, 7> kMethods{"GET",   "HEAD",   "POST",   "PUT",
                                                            "PATCH", "DELETE", "OPTIONS"};
  return std::find(kMethods.begin(), kMethods.end(), method) != kMethods.end();
}

Head read_head(std::string_view head_text, const HeadLimits& limits) {
  Head head;
  if (!read_request_line(take_line(head_text), head)) {
    return refuse(std::move(head), 400, "The request line is malformed.");
  }
  std::optional<Fields> headers = read_headers(head_text);
  if (!headers) {
    return refuse(std::move(head), 400, "The headers are malformed.");
  }
  head.headers = *std::move(headers);
  return judge(std::move(head), limits);
}

Request request_of(Head head) {
  Request request;
  const std::size_t path_end = std::min(head.target.find('?'), head.target.size());
  request.path = httplib::detail::decode_url(head.target.substr(0, path_end), false);
  if (path_end < head.target.size()) {
    httplib::Params parameters;
    httplib::detail::parse_query_text(head.target.substr(path_end + 1), parameters);
    request.query.assign(parameters.begin(), parameters.end());
  }
  request.method = std::move(head.method);
  request.headers = std::move(head.headers);
  return request;
}

}  // namespace snapthrough::server::http
