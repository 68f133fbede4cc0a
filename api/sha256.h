#pragma once
/// @file
/// SHA-256 (FIPS 180-4). The library has its own, since it must not depend on more than Eigen and a JSON
/// library; the service uses that of OpenSSL for large documents.

#include <string>
#include <string_view>

namespace snapthrough::api {

/// Returns the SHA-256 digest of the bytes as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_digest(std::string_view bytes);

}  // namespace snapthrough::api
