#pragma once
/// @file
/// Objects of the request document and their fields, as the published interface describes them (schema
/// `Request`).

#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// @brief The objects of a request that have a field of a name, as a reader calls them: `springs` for the
/// objects of /model/springs, `analysis.stop`, `members.curve of type "arc"`. Ascending by their names.
///
/// Thread-safe.
/// @param at pointer of the object that does not have the field: objects of its own kind are left out
/// @return empty when no object has the field
[[nodiscard]] std::vector<std::string> objects_with_field(std::string_view field, std::string_view at);

}  // namespace snapthrough::api
