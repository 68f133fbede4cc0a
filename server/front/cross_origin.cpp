#include "server/front/cross_origin.h"

#include <algorithm>
#include <optional>

#include "server/authority.h"

namespace snapthrough::server::http {
namespace {

/// Request headers that pages may set, in addition to those that browsers always allow.
constexpr const char* kRequestHeaders =
    "Authorization, Cache-Control, Content-Type, Idempotency-Key, If-None-Match, Last-Event-ID, Prefer, "
    "X-Request-Id, traceparent";
/// Response headers that pages may read, in addition to those that browsers always allow.
constexpr const char* kResponseHeaders =
    "Allow, Content-Location, ETag, Link, Location, Preference-Applied, Retry-After, WWW-Authenticate, "
    "X-Cache, X-Complete, X-Request-Id, X-Warnings";
/// Seconds for which browsers may cache a preflight response (Chromium: two hours at most).
constexpr const char* kMaxAge = "7200";

bool is_scheme_port(std::string_view scheme, int port) {
  return (scheme == "http" && port == 80) || (scheme == "https" && port == 443);
}

}  // namespace

bool is_origin(std::string_view text) {
  const std::size_t colon = text.find("://");
  const std::string_view scheme = text.substr(0, colon);
  if (colon == text.npos || (scheme != "http" && scheme != "https")) {
    return false;
  }
  const Authority authority = Authority::of(text.substr(colon + 3));
  const std::string_view name = without_brackets(authority.host);
  const bool bracketed = name.size() < authority.host.size();
  const std::string_view letters =
      bracketed ? ":.0123456789abcdef" : "-._0123456789abcdefghijklmnopqrstuvwxyz";
  if (name.empty() || name.find_first_not_of(letters) != name.npos) {
    return false;
  }
  const std::optional<int> port = read_port(authority.port.value_or("1"));
  return port.value_or(0) > 0 && !is_scheme_port(scheme, *port);
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
  response.headers.emplace_back("Vary", "Origin");  // for every response: caches must separate origins
  if (allows(origin)) {
    response.headers.emplace_back("Access-Control-Allow-Origin", origin);
    response.headers.emplace_back("Access-Control-Expose-Headers", kResponseHeaders);
  }
}

}  // namespace snapthrough::server::http
