#pragma once
/// @file
/// Callbacks: addresses to which the service posts the end of a job or sweep.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/check/check.h"

namespace snapthrough::server {

inline constexpr std::size_t kLongestCallback = 2000;  ///< characters

/// Whether a text is an exact `host` or `host:port` in lower case (IPv6 in brackets), without "*".
[[nodiscard]] bool is_callback_host(const std::string& host);

/// @brief Origins of the hosts: "https://host", and for a loopback host "http://host" too.
/// @pre is_callback_host(each)
[[nodiscard]] std::vector<std::string> callback_origins(const std::vector<std::string>& hosts);

/// Checks that an address is an origin of these hosts, "/", and printable ASCII without a fragment. Returns
/// the first rule that the address breaks, or nothing.
[[nodiscard]] std::optional<Finding> check_callback(std::string_view address,
                                                    const std::vector<std::string>& hosts);

}  // namespace snapthrough::server
