#pragma once
/// @file
/// JSON text to a document in memory, with bounds. Reentrant.

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "solver/check/check.h"

namespace snapthrough::api {

/// What a JSON text may hold at most; a text that holds more is refused while it is being read.
struct ParseLimits {
  int depth = 64;                  ///< arrays and objects inside one another, >= 1
  std::size_t values = 1'000'000;  ///< values of any kind, containers included, >= 1
};

/// Either `document` (not null) or `findings` (not empty).
struct ParsedText {
  std::shared_ptr<nlohmann::json> document;
  std::vector<Finding> findings;  ///< codes "malformed", "too_deep", "too_many_values", "duplicate_key"
};

/// @brief Parses RFC 8259 JSON in UTF-8, no comments, no duplicate keys, no numbers that a double cannot
/// hold.
///
/// A finding names the line, column and byte where reading stopped; its pointer is the value that was being
/// read. Memory and stack are bounded by the limits, whatever the text.
[[nodiscard]] ParsedText parse_json(std::string_view text, const ParseLimits& limits = {});

}  // namespace snapthrough::api
