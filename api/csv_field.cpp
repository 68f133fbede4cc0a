#include "api/csv_field.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace snapthrough::api {

void append_csv_field(std::string& text, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    text += field;
    return;
  }
  text += '"';
  for (const char c : field) {
    text += c;
    if (c == '"') {
      text += '"';
    }
  }
  text += '"';
}

namespace {

/// Whether a spreadsheet takes the text for a formula.
bool begins_formula(std::string_view field) {
  // full-width = + - @ (U+FF1D, FF0B, FF0D, FF20)
  static constexpr std::array<std::string_view, 8> kSigns{
      "=", "+", "-", "@", "\xEF\xBC\x9D", "\xEF\xBC\x8B", "\xEF\xBC\x8D", "\xEF\xBC\xA0"};
  if (field.starts_with('\t') || field.starts_with('\r')) {
    return true;
  }
  const std::size_t first = field.find_first_not_of(" \t\r\n\v\f");
  return first != std::string_view::npos && std::ranges::any_of(kSigns, [&](std::string_view sign) {
           return field.substr(first).starts_with(sign);
         });
}

}  // namespace

void append_csv_text(std::string& text, std::string_view field) {
  append_csv_field(text, begins_formula(field) ? "'" + std::string(field) : field);
}

}  // namespace snapthrough::api
