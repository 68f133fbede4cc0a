#pragma once
/// @file
/// Formatting of numbers in messages.

#include <cstddef>
#include <string>

namespace snapthrough {

/// How much of a list or of an id a message shows; chosen so that a message stays one sentence.
struct MessageLimits {
  static constexpr int items = 3;              ///< members or critical points that are named
  static constexpr int members_at_node = 5;    ///< members at one node that are named
  static constexpr std::size_t id_bytes = 60;  ///< bytes of an id
};

/// Shortest decimal representation that reads back to the same value, as in the result document.
[[nodiscard]] std::string number(double value);
/// Number rounded to `digits` significant digits, for quantities that occur in messages only.
[[nodiscard]] std::string rounded(double value, int digits = 3);

}  // namespace snapthrough
