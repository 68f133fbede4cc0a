#include "api/provenance.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "api/build_id.h"
#include "api/sha256.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;

/// Appends digits with a decimal exponent as ECMAScript's Number::toString does. @param digits without
/// leading and trailing zeros @param point place of the decimal point, from the first digit
void append_decimal(std::string_view digits, int point, std::string& text) {
  constexpr int kLargest = 21;
  constexpr int kSmallest = -6;
  const int count = static_cast<int>(digits.size());
  if (point > 0 && point <= kLargest) {
    const int before = std::min(point, count);
    text.append(digits.substr(0, static_cast<std::size_t>(before)));
    text.append(static_cast<std::size_t>(point - before), '0');
    if (before < count) {
      text.append(1, '.').append(digits.substr(static_cast<std::size_t>(before)));
    }
  } else if (point > kSmallest && point <= 0) {
    text.append("0.").append(static_cast<std::size_t>(-point), '0').append(digits);
  } else {
    text += digits.front();
    if (count > 1) {
      text.append(1, '.').append(digits.substr(1));
    }
    text.append(point > 0 ? "e+" : "e-").append(std::to_string(std::abs(point - 1)));
  }
}

void append_number(double number, std::string& text) {
  if (number == 0.0) {
    text += '0';
    return;
  }
  text.append(number < 0.0 ? "-" : "");
  std::array<char, 40> buffer{};
  const char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(number),
                                        std::chars_format::scientific)
                              .ptr;
  const std::string_view shortest(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  const std::size_t e = shortest.find('e');
  std::string digits(1, shortest.front());
  digits.append(shortest.substr(std::min<std::size_t>(2, e), e - std::min<std::size_t>(2, e)));
  int exponent = 0;
  const std::size_t sign = shortest[e + 1] == '+' ? 2 : 1;
  std::from_chars(shortest.data() + e + sign, end, exponent);
  append_decimal(digits, exponent + 1, text);
}

bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }

/// Appends the string as JSON. json::dump() would take most of the time for strings without escapes.
void append_string(const std::string& string, std::string& text) {
  if (!std::all_of(string.begin(), string.end(), is_plain)) {
    text += json(string).dump();
    return;
  }
  text.append(1, '"').append(string).append(1, '"');
}

/// Appends a value and its members. The parser of the document has bounded the nesting.
void append(const json& value, std::string& text) {
  if (value.is_object()) {
    text += '{';
    bool first = true;
    for (const auto& [key, member] : value.get_ref<const json::object_t&>()) {
      text.append(first ? "" : ",");
      first = false;
      append_string(key, text);
      text += ':';
      append(member, text);
    }
    text += '}';
  } else if (value.is_array()) {
    text += '[';
    bool first = true;
    for (const json& element : value) {
      text.append(first ? "" : ",");
      first = false;
      append(element, text);
    }
    text += ']';
  } else if (value.is_number()) {
    append_number(value.get<double>(), text);
  } else if (value.is_string()) {
    append_string(value.get_ref<const std::string&>(), text);
  } else {
    text += value.dump();
  }
}

}  // namespace

const Program& this_program() {
  static constexpr Program kProgram{"snapthrough", SNAPTHROUGH_VERSION, SNAPTHROUGH_BUILD,
                                    SNAPTHROUGH_TARGET};
  return kProgram;
}

json program_json() {
  const Program& program = this_program();
  return {{"name", program.name},
          {"version", program.version},
          {"build", program.build},
          {"target", program.target}};
}

const std::string& program_text() {
  static const std::string kText = program_json().dump();
  return kText;
}

std::string provenance_members(std::string_view kind, std::string_view program,
                               std::string_view request_sha256) {
  std::string text = "\"kind\": \"" + std::string(kind) + "\", \"program\": ";
  text.append(program.empty() ? "null" : program).append(", \"request_sha256\": ");
  return request_sha256.empty() ? text.append("null") : text.append("\"").append(request_sha256).append("\"");
}

std::string provenance_members(std::string_view kind, const json& document) {
  return provenance_members(kind, program_text(), request_digest(document));
}

std::string canonical_text(const json& document) {
  std::string text;
  append(document, text);
  return text;
}

std::string request_digest(const json& document) { return sha256_digest(canonical_text(document)); }

}  // namespace snapthrough::api
