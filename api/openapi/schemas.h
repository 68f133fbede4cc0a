#pragma once
/// @file
/// Look-up of schemas in the published interface. Thread-safe.

#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// @brief Returns the schema with a name under components/schemas of the OpenAPI document.
/// @throws nlohmann::json::out_of_range when the document has no schema of that name
[[nodiscard]] const nlohmann::json& published_schema(std::string_view name);

/// Returns whether a schema has anyOf, oneOf or allOf.
[[nodiscard]] bool is_choice(const nlohmann::json& schema);

/// @brief Appends a schema after all schemas that it references or chooses from, recursively. A valid value
/// satisfies at least one of them.
void expand(const nlohmann::json& schema, std::vector<const nlohmann::json*>& out);

}  // namespace snapthrough::api
