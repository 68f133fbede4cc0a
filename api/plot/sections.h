#pragma once
/// @file
/// Panels of quantities along the members of a structure, one member after another.

#include <string>
#include <vector>

#include "api/plot/looks.h"
#include "api/plot/numbers.h"

namespace snapthrough::api::plot {

/// Relative to the largest: less is rounding, and the panel says "zero".
inline constexpr double kRoundingOfSections = 1e-6;

/// Values along a member; lists of equal length, two and more.
struct SectionLine {
  std::vector<double> s, values;
};

struct SectionPanel {
  std::string name;   ///< "axial force N"
  std::string looks;  ///< section-N, section-Q or section-M
  std::string unit;
  std::vector<SectionLine> lines;  ///< one a member, in the order of the members
  double negligible = 0;           ///< values up to this size are zero
};

struct SectionMember {
  std::string id;
  double length = 0;
};

struct Sections {
  std::vector<SectionMember> members;
  std::vector<SectionPanel> panels;
  Units units;
};

/// Largest size of a value.
[[nodiscard]] double largest_of(const SectionPanel& panel);
/// Length of all members.
[[nodiscard]] double length_of(const Sections& sections);

/// Panels one below the other, extremes marked with their values; positive values upwards.
[[nodiscard]] Figure draw_sections(const Sections& sections, const std::string& caption, Size size);

}  // namespace snapthrough::api::plot
