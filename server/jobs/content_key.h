#pragma once
/// @file
/// Keys by which stored results are found for equal requests.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// @brief Key of a request, equal for requests with equal results: SHA-256 of the program's version and the
/// document with sorted keys, without spaces, and with each number in its shortest form (1, 1.0 and 1e0 are
/// one).
[[nodiscard]] std::string content_key(const nlohmann::json& document);

/// @brief Key of a point of a sweep, equal for points of one owner with equal outputs: SHA-256 of the point's
/// request as in content_key(), the pointers of the outputs (Sweep::outputs_text()), and the owner.
[[nodiscard]] std::string point_key(const nlohmann::json& document, std::string_view outputs,
                                    std::string_view owner);

}  // namespace snapthrough::server
