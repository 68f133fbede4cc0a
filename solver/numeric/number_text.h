#pragma once
/// @file
/// Formatting of numbers in messages.

#include <string>

namespace snapthrough {

/// Shortest decimal representation that reads back to the same value, as in the result document.
[[nodiscard]] std::string number(double value);
/// Number rounded to `digits` significant digits, for quantities that occur in messages only.
[[nodiscard]] std::string rounded(double value, int digits = 3);

}  // namespace snapthrough
