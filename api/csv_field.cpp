#include "api/csv_field.h"

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

void append_csv_text(std::string& text, std::string_view field) {
  constexpr std::string_view kFormula = "=+-@\t\r";
  if (field.empty() || kFormula.find(field.front()) == std::string_view::npos) {
    return append_csv_field(text, field);
  }
  append_csv_field(text, "'" + std::string(field));
}

}  // namespace snapthrough::api
