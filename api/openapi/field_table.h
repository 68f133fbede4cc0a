#pragma once
/// @file
/// Tables of fields for documents, made from the published interface.

#include <string>
#include <string_view>

namespace snapthrough::api {

/// @brief A Markdown document with the table of fields of a schema after each line `<!-- fields of SCHEMA
/// -->`: path, values, unit, description. Thread-safe.
/// @throws nlohmann::json::out_of_range when a line names a schema that does not exist
[[nodiscard]] std::string with_field_tables(std::string_view markdown);

}  // namespace snapthrough::api
