#pragma once
/// @file
/// The published interface as a text in the program; the build generates its definition.

#include <string_view>

namespace snapthrough::api {

/// Returns the OpenAPI 3.1 document (api/openapi/openapi.json).
[[nodiscard]] std::string_view openapi_document();

}  // namespace snapthrough::api
