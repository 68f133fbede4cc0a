#pragma once
/// @file
/// Marks of critical points and contact events, whose shapes differ without colour, and legends.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

enum class Mark {
  limit_max,
  limit_min,
  bifurcation,
  broken_bifurcation,
  flutter,
  capacity,
  softest,
  first_yield,
  closed,
  opened
};

/// Returns the mark of a type of critical point or contact event; nullopt for an unknown name.
[[nodiscard]] std::optional<Mark> mark_named(std::string_view name);
/// Returns the name of a mark in legends.
[[nodiscard]] const char* mark_text(Mark mark);
/// Draws a mark. Triangle: limit point, maximum (up) or minimum (down); diamond: bifurcation, hollow when
/// broken; hourglass: flutter; bar: capacity of supports; hollow square: softest point;
/// hollow triangle to the right: first yield; dot: contact made;
/// ring: contact lost.
[[nodiscard]] Shape mark_shape(Mark mark, Pixel at);

/// A legend entry: a text with a line sample or a mark.
struct LegendEntry {
  std::string text;
  std::string line;
  std::string group = "sample";  ///< CSS class of the group around the line
  std::optional<Mark> mark = std::nullopt;
};

/// Returns the height in pixels of a legend that is `width` pixels wide.
[[nodiscard]] double legend_height(const std::vector<LegendEntry>& entries, double width);
[[nodiscard]] Shape legend_shape(const std::vector<LegendEntry>& entries, double width, double top = 0);
/// Returns a legend entry for each mark, in the order of the enumeration.
[[nodiscard]] std::vector<LegendEntry> mark_entries(const std::set<Mark>& marks);

}  // namespace snapthrough::api::plot
