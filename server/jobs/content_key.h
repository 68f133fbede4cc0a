#pragma once
/// @file
/// When two requests ask for the same thing.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// @brief A key that is equal for requests with equal results: the digest of the document with keys in
/// order, no spaces, each number in its shortest form (1, 1.0 and 1e0 are one), and of the program's version.
[[nodiscard]] std::string content_key(const nlohmann::json& document);

/// @brief A key that is equal for points of sweeps with equal outputs that may be told to the same owner: of
/// the point's request as above, the pointers of the outputs (Sweep::outputs_text()), and the owner.
[[nodiscard]] std::string point_key(const nlohmann::json& document, std::string_view outputs,
                                    std::string_view owner);

}  // namespace snapthrough::server
