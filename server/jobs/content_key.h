#pragma once
/// @file
/// Keys by which stored results are found for equal requests.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// @brief Key of a request, equal for requests with equal results: SHA-256 of the program's version and the
/// document.
/// @param canonical api::canonical_text() of the document
[[nodiscard]] std::string content_key(std::string_view canonical);

/// @brief Key of a point of a sweep, equal for points of one owner with equal outputs: SHA-256 of the
/// program's version, the point's canonical request, the pointers of the outputs (Sweep::outputs_text()), and
/// the owner.
[[nodiscard]] std::string point_key(const nlohmann::json& document, std::string_view outputs,
                                    std::string_view owner);

}  // namespace snapthrough::server
