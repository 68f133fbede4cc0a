#pragma once
/// @file
/// Numbers in messages.

#include <string>

namespace snapthrough {

/// A number in a message: the fewest digits that read back to the same value, as in the result document.
[[nodiscard]] std::string number(double value);
/// A size in a message that no field of the document repeats: to so many significant digits.
[[nodiscard]] std::string rounded(double value, int digits = 3);

}  // namespace snapthrough
