#pragma once
/// @file
/// Parses JSON text with limits on depth and size. Reentrant.

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "solver/check/check.h"

namespace snapthrough::api {

/// Limits of a JSON text; the parser stops where a text exceeds them.
struct ParseLimits {
  int depth = 64;                  ///< largest nesting of arrays and objects, >= 1
  std::size_t values = 1'000'000;  ///< largest number of values, containers included, >= 1
  std::size_t keys = 1'000'000;    ///< largest number of keys in all objects; a key takes about 100 bytes
};

/// Outcome of parsing: either `document` is not null or `findings` is not empty.
struct ParsedText {
  std::shared_ptr<nlohmann::json> document;
  std::vector<Finding> findings;  ///< codes "malformed", "too_deep", "too_many_values", "too_many_keys",
                                  ///< "duplicate_key"
};

/// @brief Parses RFC 8259 JSON in UTF-8, without comments, duplicate keys or numbers beyond the range of
/// double.
///
/// A finding gives line, column and byte where the parser stopped; its pointer is the value that the parser
/// was reading. The limits bound memory and stack for any text.
[[nodiscard]] ParsedText parse_json(std::string_view text, const ParseLimits& limits = {});

}  // namespace snapthrough::api
