#pragma once
/// @file
/// Hosts and ports in addresses (RFC 3986, 3.2).

#include <optional>
#include <string_view>

namespace snapthrough::server {

/// The parts of `host` or `host:port`, not validated.
struct Authority {
  std::string_view host;                 ///< host; an IPv6 address keeps its brackets
  std::optional<std::string_view> port;  ///< text after the colon; nullopt without colon

  /// @return views into `text`, which must outlive them
  [[nodiscard]] static Authority of(std::string_view text);
};

/// Returns the host without the brackets of an IPv6 address.
[[nodiscard]] std::string_view without_brackets(std::string_view host);

/// Returns a port, 0 to 65535 in decimal digits without leading zeros; nullopt for another text.
[[nodiscard]] std::optional<int> read_port(std::string_view text);

/// Returns whether a host is "localhost", "::1" or an IPv4 address 127.x.x.x.
[[nodiscard]] bool is_loopback(std::string_view host);

}  // namespace snapthrough::server
