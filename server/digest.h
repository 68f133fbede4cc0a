#pragma once
/// @file
/// SHA-256 and comparison of secrets.

#include <string>
#include <string_view>

namespace snapthrough::server {

/// Returns the SHA-256 digest (FIPS 180-4) as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

/// Returns whether two texts are equal, in a time that depends only on their lengths.
[[nodiscard]] bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace snapthrough::server
