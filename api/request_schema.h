#pragma once
/// @file
/// Objects of the request document and their fields, according to the published interface (schema `Request`).

#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// @brief Returns the objects of a request that have a field, as messages name them: `springs` for the
/// objects of /model/springs, `analysis.stop`, `members.curve of type "arc"`. Sorted by name.
///
/// Thread-safe.
/// @param at pointer of the object that lacks the field. Where objects of the same kind but another type have
/// it, only these are returned.
/// @return empty when no object has the field
[[nodiscard]] std::vector<std::string> objects_with_field(std::string_view field, std::string_view at);

}  // namespace snapthrough::api
