#pragma once
/// @file
/// Schemas of the published interface, for whoever asks what fields a document has. Thread-safe.

#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// @brief A schema by its name under components/schemas of the OpenAPI document.
/// @throws nlohmann::json::out_of_range when there is none of that name
[[nodiscard]] const nlohmann::json& published_schema(std::string_view name);

/// Whether a schema lists other schemas to choose from.
[[nodiscard]] bool is_choice(const nlohmann::json& schema);

/// @brief Appends the schemas that a schema refers to or chooses from, through any number of references, and
/// then the schema itself: a value fulfils at least one of them.
void expand(const nlohmann::json& schema, std::vector<const nlohmann::json*>& out);

}  // namespace snapthrough::api
