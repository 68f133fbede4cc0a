#pragma once
/// @file
/// Look-up of schemas in the published interface. Thread-safe.

#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// @brief Returns the schema with a name under components/schemas of the OpenAPI document.
/// @throws nlohmann::json::out_of_range when the document has no schema of that name
[[nodiscard]] const nlohmann::json& published_schema(std::string_view name);

/// @brief Returns a schema as a document of its own: what it references is in its `$defs`, recursively.
/// @param without names of schemas whose references stay without a definition; the caller replaces them
/// @throws nlohmann::json::out_of_range when the document has no schema of that name
[[nodiscard]] nlohmann::json standalone_schema(std::string_view name,
                                               const std::set<std::string>& without = {});

/// Returns whether a schema has anyOf, oneOf or allOf.
[[nodiscard]] bool is_choice(const nlohmann::json& schema);

/// @brief Appends a schema after all schemas that it references or chooses from, recursively. A valid value
/// satisfies at least one of them.
void expand(const nlohmann::json& schema, std::vector<const nlohmann::json*>& out);

}  // namespace snapthrough::api
