#pragma once
/// @file
/// SHA-256, and comparing secrets.

#include <string>
#include <string_view>

namespace snapthrough::server {

/// SHA-256 (FIPS 180-4), 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

/// Whether two texts are equal, in a time that depends on their lengths alone.
[[nodiscard]] bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace snapthrough::server
