#pragma once
/// @file
/// Documents that are built into the program. Defined in a source generated at build time.

#include <string_view>
#include <vector>

namespace snapthrough::server::http {

/// A document of the folder examples/, or of one in it.
struct Example {
  std::string_view name;      ///< file name without ending
  std::string_view document;  ///< JSON text
};

/// Request documents: examples/*.json.
[[nodiscard]] const std::vector<Example>& embedded_examples();
/// Components: examples/components/*.json.
[[nodiscard]] const std::vector<Example>& embedded_components();

}  // namespace snapthrough::server::http
