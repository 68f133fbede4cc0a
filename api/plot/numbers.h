#pragma once
/// @file
/// How figures write numbers and units: significant digits, thin spaces between thousands, powers of ten as
/// superscripts.

#include <string>

namespace snapthrough::api::plot {

/// @brief A number with so many significant digits, trailing zeros left out; below 1e-3 and from 1e6 on with
/// a power of ten. What is not finite is a dash.
[[nodiscard]] std::string format_number(double value, int digits = 4);

/// The model's labels of its units; empty where they are not known.
struct Units {
  std::string length;
  std::string force;
  std::string moment;
};

enum class Quantity { length, rotation, force, moment, line_load };

/// The unit of a quantity; "" where the labels do not tell.
[[nodiscard]] std::string unit_of(const Units& units, Quantity quantity);
/// A number and its unit, with a space that does not break.
[[nodiscard]] std::string with_unit(double value, const std::string& unit, int digits = 4);
/// "name (unit)", or the name alone.
[[nodiscard]] std::string name_with_unit(const std::string& name, const std::string& unit);

}  // namespace snapthrough::api::plot
