#include "server/jobs/callback.h"

#include <arpa/inet.h>

#include <algorithm>

#include "server/authority.h"

namespace snapthrough::server {
namespace {

constexpr std::string_view kHostCharacters = "abcdefghijklmnopqrstuvwxyz0123456789.-";

}  // namespace

bool is_callback_host(const std::string& text) {
  const Authority authority = Authority::of(text);
  if (authority.host.empty() || read_port(authority.port.value_or("1")).value_or(0) == 0) {
    return false;
  }
  if (authority.host.front() != '[') {
    return authority.host.find_first_not_of(kHostCharacters) == std::string_view::npos;
  }
  in6_addr address{};
  return ::inet_pton(AF_INET6, std::string(without_brackets(authority.host)).c_str(), &address) == 1;
}

std::vector<std::string> callback_origins(const std::vector<std::string>& hosts) {
  std::vector<std::string> origins;
  for (const std::string& host : hosts) {
    origins.push_back("https://" + host);
    if (is_loopback(without_brackets(Authority::of(host).host))) {
      origins.push_back("http://" + host);
    }
  }
  return origins;
}

std::optional<Finding> check_callback(std::string_view address, const std::vector<std::string>& hosts) {
  if (hosts.empty()) {
    return Finding{"/callback", "not_allowed", "this service makes no callbacks: callback_hosts is empty"};
  }
  if (address.size() > kLongestCallback) {
    return Finding{"/callback", "out_of_range",
                   "expected at most " + std::to_string(kLongestCallback) + " characters, got " +
                       std::to_string(address.size())};
  }
  const std::vector<std::string> origins = callback_origins(hosts);
  const bool allowed = std::any_of(origins.begin(), origins.end(), [&](const std::string& origin) {
    return address.starts_with(origin + "/");
  });
  if (!allowed) {
    std::string list;
    for (const std::string& origin : origins) {
      list += (list.empty() ? "" : ", ") + origin + "/";
    }
    return Finding{"/callback", "not_allowed", "expected an address that begins with one of: " + list};
  }
  const bool plain =
      std::all_of(address.begin(), address.end(), [](char c) { return c > ' ' && c <= '~' && c != '#'; });
  return plain ? std::nullopt
               : std::optional(Finding{"/callback", "not_allowed",
                                       "expected printable ASCII without blanks and #; others as %XX"});
}

}  // namespace snapthrough::server
