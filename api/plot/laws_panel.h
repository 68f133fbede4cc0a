#pragma once
/// @file
/// One diagram of laws: curves of a group by depth, distance or name, with their key.

#include <optional>
#include <string>
#include <vector>

#include "api/plot/axes.h"
#include "api/plot/geometry.h"
#include "api/plot/law_group.h"
#include "api/plot/numbers.h"

namespace snapthrough::api::plot {

/// A law in the values of the axes, with the sense of its displacement.
struct DrawnLaw {
  std::string name;               ///< place, as in the key
  std::vector<Point> points;      ///< up to where it is constant
  std::vector<Point> flat;        ///< constant part; empty: it is not drawn
  std::vector<Point> other_flat;  ///< that of the other sense, where both are drawn
  std::optional<Point> peak;      ///< where it falls beyond
  std::optional<Point> residual;  ///< where it has fallen to a constant
};

/// What a diagram shows.
struct LawPanel {
  const LawGroup* group = nullptr;
  std::vector<DrawnLaw> laws;  ///< the shown ones
  std::string given_by;        ///< ids of what gives the laws
  std::string note;            ///< how many are shown, and in which senses
  std::string key;             ///< what the key tells, with its unit
  Frame frame;                 ///< in pixels from the corner of the diagram
};

/// Chooses and computes the laws that find room in a diagram of this size.
[[nodiscard]] LawPanel law_panel(const LawGroup& group, const Units& units, Size size);
/// Draws a diagram. @param number of the diagram, from 0
[[nodiscard]] Shape law_panel_shape(const LawPanel& panel, Size size, Pixel corner, std::size_t number);
/// Returns what a diagram shows in sentences.
[[nodiscard]] std::string law_panel_text(const LawPanel& panel, const Units& units);

}  // namespace snapthrough::api::plot
