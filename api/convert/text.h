#pragma once
/// @file
/// Texts of tables and drawings.

#include <optional>
#include <string_view>

namespace snapthrough::api::convert {

/// Bytes that some programs write before text in UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Returns whether a text is UTF-8 (RFC 3629): no overlong forms, surrogates or code points above U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view text);

/// Returns a text without spaces, tabs and carriage returns at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Returns the number that is the whole text, such as "-1.5e3"; nullopt for other texts.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
[[nodiscard]] std::optional<int> parse_integer(std::string_view text);

}  // namespace snapthrough::api::convert
