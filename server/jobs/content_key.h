#pragma once
/// @file
/// When two requests ask for the same thing.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace snapthrough::server {

/// @brief A key that is equal for requests with equal results: the digest of the document with keys in
/// order, no spaces, each number in its shortest form (1, 1.0 and 1e0 are one), and of the program's version.
[[nodiscard]] std::string content_key(const nlohmann::json& document);

}  // namespace snapthrough::server
