#pragma once
/// @file
/// Marks of charts, each kind of its own form so that they are told apart without colour, and legends.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

enum class Mark { limit_max, limit_min, bifurcation, broken_bifurcation, softest, closed, opened };

/// The mark of a type of critical point or contact event; nothing for another name.
[[nodiscard]] std::optional<Mark> mark_named(std::string_view name);
/// What a legend calls it.
[[nodiscard]] const char* mark_text(Mark mark);
/// Triangle up or down: limit point; diamond: bifurcation, hollow when broken; hollow square: softest point;
/// dot: contact made, ring: lost.
[[nodiscard]] Shape mark_shape(Mark mark, Pixel at);

/// A line with its looks, or a mark, and its name.
struct LegendEntry {
  std::string text;
  std::string line;
  std::string group = "sample";  ///< looks of the group around the line
  std::optional<Mark> mark = std::nullopt;
};

/// Height of a legend in a figure of a width.
[[nodiscard]] double legend_height(const std::vector<LegendEntry>& entries, double width);
[[nodiscard]] Shape legend_shape(const std::vector<LegendEntry>& entries, double width, double top = 0);
/// Entries of marks in their usual order.
[[nodiscard]] std::vector<LegendEntry> mark_entries(const std::set<Mark>& marks);

}  // namespace snapthrough::api::plot
