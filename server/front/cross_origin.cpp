#include "server/front/cross_origin.h"

#include <algorithm>

namespace snapthrough::server::http {
namespace {

/// Headers of requests that a page may set, beside those it always may.
constexpr const char* kRequestHeaders =
    "Authorization, Cache-Control, Content-Type, Idempotency-Key, If-None-Match, Last-Event-ID, Prefer, "
    "X-Request-Id, traceparent";
/// Headers of responses that a page may read, beside those it always may.
constexpr const char* kResponseHeaders =
    "Allow, Content-Location, ETag, Link, Location, Preference-Applied, Retry-After, WWW-Authenticate, "
    "X-Cache, X-Complete, X-Request-Id";
/// Browsers keep the answer so long, in seconds (Chromium two hours at most).
constexpr const char* kMaxAge = "7200";

bool is_port(std::string_view text, std::string_view scheme) {
  const bool digits = !text.empty() && text.size() <= 5 && text.front() != '0' &&
                      text.find_first_not_of("0123456789") == text.npos;
  const bool own = (scheme == "http" && text == "80") || (scheme == "https" && text == "443");
  return digits && !own && (text.size() < 5 || text <= "65535");
}

}  // namespace

bool is_origin(std::string_view text) {
  const std::size_t colon = text.find("://");
  const std::string_view scheme = text.substr(0, colon);
  if (colon == text.npos || (scheme != "http" && scheme != "https")) {
    return false;
  }
  const std::string_view rest = text.substr(colon + 3);
  const bool bracketed = rest.starts_with('[');
  const std::size_t closing = rest.find(']');
  if (bracketed && closing == rest.npos) {
    return false;
  }
  const std::size_t end = std::min(rest.find(':', bracketed ? closing : 0), rest.size());
  const std::string_view host = rest.substr(0, end);
  const std::string_view letters =
      bracketed ? "[]:.0123456789abcdef" : "-._0123456789abcdefghijklmnopqrstuvwxyz";
  const bool good_host =
      !host.empty() && host.find_first_not_of(letters) == host.npos && (!bracketed || closing + 1 == end);
  return good_host && (end == rest.size() || is_port(rest.substr(end + 1), scheme));
}

bool CrossOrigin::allows(std::string_view origin) const {
  return std::find(allowed_.begin(), allowed_.end(), origin) != allowed_.end();
}

bool CrossOrigin::is_preflight(const Request& request) const {
  return request.method == "OPTIONS" && request.header("Access-Control-Request-Method") &&
         allows(request.header("Origin").value_or(""));
}

Response CrossOrigin::preflight(const std::string& methods) {
  Response response;
  response.status = 204;
  response.headers = {{"Access-Control-Allow-Methods", methods},
                      {"Access-Control-Allow-Headers", kRequestHeaders},
                      {"Access-Control-Max-Age", kMaxAge}};
  return response;
}

void CrossOrigin::mark(std::string_view origin, Response& response) const {
  if (allowed_.empty()) {
    return;
  }
  response.headers.emplace_back("Vary", "Origin");  // also without one: a cache must not mix them up
  if (allows(origin)) {
    response.headers.emplace_back("Access-Control-Allow-Origin", origin);
    response.headers.emplace_back("Access-Control-Expose-Headers", kResponseHeaders);
  }
}

}  // namespace snapthrough::server::http
