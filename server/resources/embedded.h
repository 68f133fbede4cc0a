#pragma once
/// @file
/// Documents in the program; the build generates their definition.

#include <string_view>
#include <vector>

namespace snapthrough::server::http {

/// A document of the folder examples/ or a subfolder.
struct Example {
  std::string_view name;      ///< file name without extension
  std::string_view document;  ///< document as JSON text
};

/// Returns the request documents examples/*.json.
[[nodiscard]] const std::vector<Example>& embedded_examples();
/// Returns the components examples/components/*.json.
[[nodiscard]] const std::vector<Example>& embedded_components();

}  // namespace snapthrough::server::http
