#pragma once
/// @file
/// Signatures of callbacks, as https://www.standardwebhooks.com has them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// @brief The key in a text "whsec_<base64>", white space around it ignored; nothing when it has another form
/// or is not 24 to 64 bytes long.
[[nodiscard]] std::optional<std::string> webhook_key(std::string_view text);

/// "v1," and the base64 of HMAC-SHA256(key, "<id>.<timestamp>.<body>").
/// @param timestamp seconds since 1970
[[nodiscard]] std::string webhook_signature(std::string_view key, std::string_view id, std::int64_t timestamp,
                                            std::string_view body);

}  // namespace snapthrough::server
