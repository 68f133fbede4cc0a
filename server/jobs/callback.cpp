#include "server/jobs/callback.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>

namespace snapthrough::server {
namespace {

constexpr std::string_view kHostCharacters = "abcdefghijklmnopqrstuvwxyz0123456789.-";

/// "host:port" in parts, the host with its brackets; the port is empty when there is none.
std::pair<std::string_view, std::optional<std::string_view>> split(std::string_view host) {
  const std::size_t colon = host.find(':', host.starts_with('[') ? std::min(host.find(']'), host.size()) : 0);
  if (colon == std::string_view::npos) {
    return {host, std::nullopt};
  }
  return {host.substr(0, colon), host.substr(colon + 1)};
}

bool is_port(std::string_view text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size() && port > 0 && port <= 65535 &&
         text[0] != '0';
}

std::string without_brackets(std::string_view host) {
  const bool brackets = host.size() > 2 && host.front() == '[' && host.back() == ']';
  return std::string(brackets ? host.substr(1, host.size() - 2) : host);
}

}  // namespace

bool is_loopback(const std::string& host) {
  in_addr address{};
  const bool numeric = ::inet_pton(AF_INET, host.c_str(), &address) == 1;
  return host == "localhost" || host == "::1" || (numeric && ntohl(address.s_addr) >> 24 == 127);
}

bool is_callback_host(const std::string& text) {
  const auto [host, port] = split(text);
  if (host.empty() || (port && !is_port(*port))) {
    return false;
  }
  if (host.front() != '[') {
    return host.find_first_not_of(kHostCharacters) == std::string_view::npos;
  }
  in6_addr address{};
  return ::inet_pton(AF_INET6, without_brackets(host).c_str(), &address) == 1;
}

std::vector<std::string> callback_origins(const std::vector<std::string>& hosts) {
  std::vector<std::string> origins;
  for (const std::string& host : hosts) {
    origins.push_back("https://" + host);
    if (is_loopback(without_brackets(split(host).first))) {
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
