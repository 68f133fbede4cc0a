#pragma once
/// @file
/// Signatures of callbacks (https://www.standardwebhooks.com).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// @brief Returns the key in a text "whsec_<base64>" with optional white space around it; nullopt for another
/// format or a key that is not 24 to 64 bytes long.
[[nodiscard]] std::optional<std::string> webhook_key(std::string_view text);

/// Returns "v1," and the base64 of HMAC-SHA256(key, "<id>.<timestamp>.<body>").
/// @param timestamp seconds since 1970
[[nodiscard]] std::string webhook_signature(std::string_view key, std::string_view id, std::int64_t timestamp,
                                            std::string_view body);

}  // namespace snapthrough::server
