#pragma once
/// @file
/// Diagrams of quantities along members, one member after another, one panel below the other.

#include <string>
#include <vector>

#include "api/plot/looks.h"
#include "api/plot/numbers.h"

namespace snapthrough::api::plot {

/// Relative limit of rounding: a panel whose values are all smaller shows "zero".
inline constexpr double kRoundingOfSections = 1e-6;

/// Values over the arc length of a member; lists of equal length, at least two.
struct SectionLine {
  std::vector<double> s, values;
};

struct SectionPanel {
  std::string name;   ///< title, such as "axial force N"
  std::string looks;  ///< CSS class: section-N, section-Q or section-M
  std::string unit;
  std::vector<SectionLine> lines;  ///< one line for each member, in the order of members
  double negligible = 0;           ///< values up to this size are drawn as zero
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

/// Returns the largest absolute value of a panel.
[[nodiscard]] double largest_of(const SectionPanel& panel);
/// Returns the sum of the members' lengths, or 1 when that is zero.
[[nodiscard]] double length_of(const Sections& sections);

/// Draws the panels below one another with their extreme values marked; positive values point up.
[[nodiscard]] Figure draw_sections(const Sections& sections, const std::string& caption, Size size);

}  // namespace snapthrough::api::plot
