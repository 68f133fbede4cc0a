#include "server/jobs/content_key.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "server/digest.h"

namespace snapthrough::server {
namespace {

using nlohmann::json;

/// Integers up to 2^53, which a double holds exactly, are written like doubles.
constexpr double kExact = 9007199254740992.0;

void append_number(const json& value, std::string& text) {
  const auto number = value.get<double>();
  std::array<char, 40> digits{};
  if (value.is_number_integer() && std::abs(number) >= kExact) {
    text += value.dump();
    return;
  }
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number + 0.0);
  text.append(digits.data(), end);
}

bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }

/// Appends the string as JSON. json::dump() would take most of the time of content_key() for strings without
/// escapes.
void append_string(const std::string& string, std::string& text) {
  if (!std::all_of(string.begin(), string.end(), is_plain)) {
    text += json(string).dump();
    return;
  }
  text += '"';
  text += string;
  text += '"';
}

/// Appends a value and its members. The parser of the document has bounded the nesting.
void append(const json& value, std::string& text) {
  if (value.is_object()) {
    text += '{';
    for (const auto& [key, member] : value.get_ref<const json::object_t&>()) {
      append_string(key, text);
      text += ':';
      append(member, text);
      text += ',';
    }
    text += '}';
  } else if (value.is_array()) {
    text += '[';
    for (const json& element : value) {
      append(element, text);
      text += ',';
    }
    text += ']';
  } else if (value.is_number()) {
    append_number(value, text);
  } else if (value.is_string()) {
    append_string(value.get_ref<const std::string&>(), text);
  } else {
    text += value.dump();
  }
}

}  // namespace

std::string content_key(const json& document) {
  std::string text = "snapthrough " SNAPTHROUGH_VERSION " request 1 ";
  append(document, text);
  return sha256_hex(text);
}

std::string point_key(const json& document, std::string_view outputs, std::string_view owner) {
  std::string text = "snapthrough " SNAPTHROUGH_VERSION " point 1 ";
  text.append(outputs).append(json(owner).dump(-1, ' ', false, json::error_handler_t::replace));
  append(document, text);
  return sha256_hex(text);
}

}  // namespace snapthrough::server
