#include "api/plot/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace snapthrough::api::plot {
namespace {

constexpr const char* kThinSpace = "\u202f";
constexpr const char* kNoBreak = "\u00a0";
constexpr const char* kMinus = "\u2212";
constexpr const char* kSuperscripts[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};

std::string superscript(int value) {
  std::string text = value < 0 ? "\u207b" : "";
  for (const char digit : std::to_string(std::abs(value))) {
    text += kSuperscripts[digit - '0'];
  }
  return text;
}

std::string written(double value, std::chars_format format, int decimals) {
  char digits[400];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value, format, decimals);
  return {std::begin(digits), end.ptr};
}

/// Removes trailing zeros of the decimals.
std::string trimmed(std::string text) {
  if (text.find('.') == std::string::npos) {
    return text;
  }
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text;
}

/// Inserts thin spaces between thousands of numbers with five or more digits.
std::string grouped(const std::string& text) {
  const std::size_t whole = std::min(text.find('.'), text.size());
  if (whole <= 4) {
    return text;
  }
  std::string parted;
  for (std::size_t i = 0; i < whole; ++i) {
    if (i > 0 && (whole - i) % 3 == 0) {
      parted += kThinSpace;
    }
    parted += text[i];
  }
  return parted + text.substr(whole);
}

}  // namespace

std::string format_number(double value, int digits) {
  if (!std::isfinite(value)) {
    return "\u2013";
  }
  if (value == 0) {
    return "0";
  }
  const std::string sign = value < 0 ? kMinus : "";
  const std::string scientific = written(std::abs(value), std::chars_format::scientific, digits - 1);
  const std::size_t e = scientific.find('e');
  const int exponent = std::atoi(scientific.c_str() + e + 1);
  if (exponent >= -3 && exponent < 6) {
    return sign + grouped(trimmed(written(std::abs(value), std::chars_format::fixed,
                                          std::max(0, digits - 1 - exponent))));
  }
  const std::string factor = trimmed(scientific.substr(0, e));
  const std::string ten = "10" + superscript(exponent);
  return factor == "1" ? sign + ten : sign + factor + kThinSpace + "\u00d7" + kThinSpace + ten;
}

std::string unit_of(const Units& units, Quantity quantity) {
  const bool both = !units.length.empty() && !units.force.empty();
  switch (quantity) {
    case Quantity::length:
      return units.length;
    case Quantity::rotation:
      return "rad";
    case Quantity::force:
      return units.force;
    case Quantity::moment:
      return !units.moment.empty() ? units.moment : both ? units.force + kThinSpace + units.length : "";
    case Quantity::line_load:
      return both ? units.force + "/" + units.length : "";
  }
  return "";
}

std::string with_unit(double value, const std::string& unit, int digits) {
  return unit.empty() ? format_number(value, digits) : format_number(value, digits) + kNoBreak + unit;
}

std::string name_with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " (" + unit + ")";
}

}  // namespace snapthrough::api::plot
