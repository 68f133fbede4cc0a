#pragma once
/// @file
/// The part of a document that a reader with little room sees first.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

namespace snapthrough::server::mcp {

/// @brief Returns a document without its long lists, and where they were: `left_out` is a list of
/// `{"pointer", "items"}`, sorted by pointer; it is absent when nothing was left out.
/// @param document an object
/// @param most largest number of items of a list that stays
[[nodiscard]] nlohmann::json digest_of(const nlohmann::json& document, std::size_t most);

}  // namespace snapthrough::server::mcp
