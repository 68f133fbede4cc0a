#pragma once
/// @file
/// Addresses that are told of the end of a job or sweep.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/check/check.h"

namespace snapthrough::server {

inline constexpr std::size_t kLongestCallback = 2000;  ///< characters

/// Whether it is an exact `host` or `host:port` in lower case (IPv6 in brackets), without "*".
[[nodiscard]] bool is_callback_host(const std::string& host);

/// @brief What addresses at these hosts begin with: "https://host"; "http://host" too for loopback hosts.
/// @pre is_callback_host(each)
[[nodiscard]] std::vector<std::string> callback_origins(const std::vector<std::string>& hosts);

/// The rule that an address does not follow, or nothing: an origin of these hosts, a "/", printable ASCII
/// without a fragment.
[[nodiscard]] std::optional<Finding> check_callback(std::string_view address,
                                                    const std::vector<std::string>& hosts);

}  // namespace snapthrough::server
