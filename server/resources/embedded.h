#pragma once
/// @file
/// Documents that are built into the program. Defined in a source generated at build time.

#include <string_view>
#include <vector>

namespace snapthrough::server::http {

/// A request document of the folder examples/.
struct Example {
  std::string_view name;      ///< file name without ending
  std::string_view document;  ///< JSON text
};

[[nodiscard]] const std::vector<Example>& embedded_examples();

}  // namespace snapthrough::server::http
