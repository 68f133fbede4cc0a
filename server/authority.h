#pragma once
/// @file
/// Hosts and ports as addresses have them (RFC 3986, 3.2).

#include <optional>
#include <string_view>

namespace snapthrough::server {

/// The parts of `host` or `host:port`, neither of them checked.
struct Authority {
  std::string_view host;                 ///< IPv6 addresses in their brackets
  std::optional<std::string_view> port;  ///< nothing without a colon after the host

  /// @return parts of the text, which must outlive them
  [[nodiscard]] static Authority of(std::string_view text);
};

/// The host without the brackets of an IPv6 address.
[[nodiscard]] std::string_view without_brackets(std::string_view host);

/// 0 to 65535 in decimal digits without leading zeros, or nothing.
[[nodiscard]] std::optional<int> read_port(std::string_view text);

/// Whether it is "localhost", "::1" or an IPv4 address 127.x.x.x.
[[nodiscard]] bool is_loopback(std::string_view host);

}  // namespace snapthrough::server
