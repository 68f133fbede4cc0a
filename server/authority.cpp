#include "server/authority.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <string>

namespace snapthrough::server {

Authority Authority::of(std::string_view text) {
  const std::size_t closing = text.starts_with('[') ? std::min(text.find(']'), text.size()) : 0;
  const std::size_t colon = text.find(':', closing);
  if (colon == std::string_view::npos) {
    return {text, std::nullopt};
  }
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::string_view without_brackets(std::string_view host) {
  const bool brackets = host.size() >= 2 && host.front() == '[' && host.back() == ']';
  return brackets ? host.substr(1, host.size() - 2) : host;
}

std::optional<int> read_port(std::string_view text) {
  int port = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  const bool plain = whole && (text.front() != '0' || text.size() == 1);
  return plain && port >= 0 && port <= 65535 ? std::optional(port) : std::nullopt;
}

bool is_loopback(std::string_view host) {
  in_addr address{};
  const bool numeric = ::inet_pton(AF_INET, std::string(host).c_str(), &address) == 1;
  return host == "localhost" || host == "::1" || (numeric && ntohl(address.s_addr) >> 24 == 127);
}

}  // namespace snapthrough::server
