#pragma once
/// @file
/// Numbers in messages.

#include <string>

namespace snapthrough {

/// A number in a message: the fewest digits that read back to the same value, as in the result document.
[[nodiscard]] std::string number(double value);
/// A size in a message that no field of the document repeats: three significant digits.
[[nodiscard]] std::string rounded(double value);

}  // namespace snapthrough
