#pragma once
/// @file
/// Text of numbers and units in figures: significant digits, thin spaces between thousands, superscript
/// exponents.

#include <string>

namespace snapthrough::api::plot {

/// @brief Returns a number with at most `digits` significant digits, without trailing zeros; with a power of
/// ten when its size is below 1e-3 or at least 1e6. A value that is not finite becomes a dash.
[[nodiscard]] std::string format_number(double value, int digits = 4);

/// Unit labels of the model; empty when not given.
struct Units {
  std::string length;
  std::string force;
  std::string moment;
};

enum class Quantity { length, rotation, force, moment, line_load };

/// Returns the unit label of a quantity; "" when the model has no label for it.
[[nodiscard]] std::string unit_of(const Units& units, Quantity quantity);
/// Returns a number and its unit with a non-breaking space between them.
[[nodiscard]] std::string with_unit(double value, const std::string& unit, int digits = 4);
/// Returns "name (unit)", or the name alone when the unit is empty.
[[nodiscard]] std::string name_with_unit(const std::string& name, const std::string& unit);

}  // namespace snapthrough::api::plot
