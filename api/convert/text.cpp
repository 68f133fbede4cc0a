#include "api/convert/text.h"

#include <charconv>
#include <cstddef>

namespace snapthrough::api::convert {

namespace {

/// Returns the number of bytes of the character that a text begins with; 0 when it is not UTF-8.
std::size_t character_length(std::string_view text) {
  struct Form {
    unsigned char first, last;     ///< range of the first byte
    unsigned char least, largest;  ///< range of the second byte; later bytes: 0x80 to 0xBF
    std::size_t length;
  };
  static constexpr Form kForms[] = {
      {0x00, 0x7F, 0x00, 0x00, 1}, {0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
      {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3}, {0xEE, 0xEF, 0x80, 0xBF, 3},
      {0xF0, 0xF0, 0x90, 0xBF, 4}, {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4}};
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  for (const Form& form : kForms) {
    if (byte(0) < form.first || byte(0) > form.last) {
      continue;
    }
    bool holds = text.size() >= form.length;
    for (std::size_t i = 1; holds && i < form.length; ++i) {
      holds = byte(i) >= (i == 1 ? form.least : 0x80) && byte(i) <= (i == 1 ? form.largest : 0xBF);
    }
    return holds ? form.length : 0;
  }
  return 0;
}

template <class T>
std::optional<T> parse_whole(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional<T>(value) : std::nullopt;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) {
      return false;
    }
    text.remove_prefix(length);
  }
  return true;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::optional<double> parse_number(std::string_view text) { return parse_whole<double>(text); }
std::optional<int> parse_integer(std::string_view text) { return parse_whole<int>(text); }

}  // namespace snapthrough::api::convert
