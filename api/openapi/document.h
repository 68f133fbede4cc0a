#pragma once
/// @file
/// The published interface, built into the program. Defined in a source generated at build time.

#include <string_view>

namespace snapthrough::api {

/// The OpenAPI 3.1 document, api/openapi/openapi.json.
[[nodiscard]] std::string_view openapi_document();

}  // namespace snapthrough::api
