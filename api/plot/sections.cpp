#include "api/plot/sections.h"

#include <algorithm>
#include <cmath>

#include "api/plot/axes.h"
#include "api/plot/labels.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kCaption = 22;
constexpr double kTitle = 20;
constexpr double kHead = 20;   // pixels above the highest point for a value
constexpr double kBelow = 20;  // pixels below the lowest point for a value
constexpr double kFoot = 20;   // pixels for member ids or lengths
constexpr double kRowGap = 10;
constexpr double kSide = 4;

/// A panel with its scales and position.
struct Placed {
  const SectionPanel* panel;
  Scale x;
  Scale y;
  double top = 0;   ///< top of the title
  double foot = 0;  ///< top of the row of member ids or lengths
  bool zero = false;
};

Range range_of(const SectionPanel& panel) {
  Range range(0, 0);
  for (const SectionLine& line : panel.lines) {
    for (const double value : line.values) {
      range.include(value);
    }
  }
  return range;
}

Placed placed_panel(const SectionPanel& panel, double length, double top, double height, double width) {
  Range range = range_of(panel);
  Placed placed;
  placed.zero = !(std::max(-range.low, range.high) > panel.negligible);
  if (placed.zero) {
    range = {-1, 1};
  }
  const double below = range.low < 0 ? kBelow : 0;
  const double start = top + height - kFoot - below;
  const double end = top + kTitle + (range.high > 0 ? kHead : 6);
  placed.panel = &panel;
  placed.x = {0, length, kSide, width - kSide};
  placed.y = {range.low, range.high, std::max(start, end + 8), end};
  placed.top = top;
  placed.foot = placed.y.start + below;
  return placed;
}

struct Extreme {
  Pixel at;
  double value;
};

/// Returns the largest and smallest value; leaves out one that is small or nearly equal to the other.
std::vector<Extreme> extremes_of(const Sections& sections, const Placed& placed) {
  constexpr double kAlike = 0.02;  // relative difference below which one extreme is marked
  constexpr double kSmall = 0.03;
  std::optional<Extreme> low;
  std::optional<Extreme> high;
  double from = 0;
  for (std::size_t m = 0; m < sections.members.size(); ++m) {
    const SectionLine& line = placed.panel->lines[m];
    for (std::size_t i = 0; i < line.s.size(); ++i) {
      const double value = line.values[i];
      const Extreme here{{place(placed.x, from + line.s[i]), place(placed.y, value)}, value};
      if (!low || value < low->value) {
        low = here;
      }
      if (!high || value > high->value) {
        high = here;
      }
    }
    from += sections.members[m].length;
  }
  if (!low) {
    return {};
  }
  const double largest = std::max(std::abs(high->value), std::abs(low->value));
  std::vector<Extreme> both{*high, *low};
  if (high->value - low->value < kAlike * largest) {
    both = {std::abs(low->value) > std::abs(high->value) ? *low : *high};
  }
  std::erase_if(both, [&](const Extreme& one) { return !(std::abs(one.value) > kSmall * largest); });
  return both;
}

void draw_curves(const Sections& sections, const Placed& placed, Occupancy& taken,
                 std::vector<Shape>& shapes) {
  const double zero = place(placed.y, 0);
  double from = 0;
  for (std::size_t m = 0; m < sections.members.size(); ++m) {
    const SectionLine& line = placed.panel->lines[m];
    std::vector<Pixel> all;
    for (std::size_t i = 0; i < line.s.size(); ++i) {
      all.push_back({place(placed.x, from + line.s[i]), place(placed.y, line.values[i])});
    }
    const std::vector<Pixel> points = thinned_points(all);
    taken.add_line(points, 20);
    std::vector<Pixel> area{{points.front().x, zero}};
    area.insert(area.end(), points.begin(), points.end());
    area.push_back({points.back().x, zero});
    shapes.push_back(path("section-area", area, true));
    shapes.push_back(path("section-line", points));
    from += sections.members[m].length;
  }
}

/// Draws lines where members meet, and member ids when there is room.
void draw_members(const Sections& sections, const Placed& placed, std::vector<Shape>& shapes) {
  double from = 0;
  double drawn_at = 0;
  for (std::size_t m = 0; m < sections.members.size(); ++m) {
    const auto& [id, length] = sections.members[m];
    const double left = place(placed.x, from);
    const double right = place(placed.x, from + length);
    if (m > 0 && left - drawn_at > 1) {  // lines less than a pixel apart are drawn once
      shapes.push_back(line("section-joint", {left, placed.foot}, {left, placed.y.end}));
      drawn_at = left;
    }
    const double width = right - left - 6;
    if (sections.members.size() > 1 && width > 18) {
      shapes.push_back(
          label("tick", {(left + right) / 2, placed.foot + 14}, Anchor::middle, fitted(id, width)));
    }
    from += length;
  }
}

/// Draws the axis of arc length below a single member.
void draw_lengths(const Sections& sections, const Placed& placed, std::vector<Shape>& shapes) {
  if (sections.members.size() != 1) {
    return;
  }
  const std::vector<double> marks = ticks(placed.x, 80);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double x = place(placed.x, marks[i]);
    const Anchor anchor = x - placed.x.start < 12 ? Anchor::start
                          : placed.x.end - x < 24 ? Anchor::end
                                                  : Anchor::middle;
    const bool last = i + 1 == marks.size();
    shapes.push_back(line("axis", {x, placed.foot}, {x, placed.foot + 3}));
    shapes.push_back(label("tick", {x, placed.foot + 15}, anchor,
                           i == 0 && marks[i] == 0 ? "s = 0"
                           : last                  ? with_unit(marks[i], sections.units.length)
                                                   : format_number(marks[i])));
  }
}

/// Returns the covered area: everything outside the panel, and its title.
Occupancy room_of(const Placed& placed, Size size, double title) {
  Occupancy taken(size);
  const double bottom = placed.foot + kFoot;
  taken.add_box({0, 0, placed.x.start - 4, size.height});
  taken.add_box({placed.x.end + 4, 0, size.width, size.height});
  taken.add_box({placed.x.start, placed.top - 2, placed.x.start + title + 8, placed.top + 15});
  taken.add_box({placed.x.start, placed.foot + 3, placed.x.end, bottom});
  taken.add_box({0, 0, size.width, std::max(0.0, placed.top - 4)});
  taken.add_box({0, bottom, size.width, size.height});
  return taken;
}

Shape panel_shape(const Sections& sections, const Placed& placed, Size size) {
  const auto& [name, looks, unit, lines, negligible] = *placed.panel;
  std::vector<Shape> title{element("tspan", {{"class", "strong"}}, {text_node(name)})};
  if (!unit.empty()) {
    title.push_back(text_node(" "));
    title.push_back(element("tspan", {{"class", "muted"}}, {text_node(unit)}));
  }
  Occupancy taken = room_of(placed, size, text_width(name, 12, true) + text_width(" " + unit));
  std::vector<Shape> shapes{
      label_of("section-title", {placed.x.start, placed.top + 13}, Anchor::start, std::move(title))};
  const double zero = place(placed.y, 0);
  if (placed.zero) {
    shapes.push_back(label("muted", {placed.x.start, zero - 5}, Anchor::start, "zero"));
  } else {
    draw_curves(sections, placed, taken, shapes);
  }
  shapes.push_back(line("axis", {placed.x.start, zero}, {placed.x.end, zero}));
  draw_members(sections, placed, shapes);
  draw_lengths(sections, placed, shapes);
  if (!placed.zero) {
    for (const auto& [at, value] : extremes_of(sections, placed)) {
      shapes.push_back(circle("section-dot", at, 2.8));
      LabelRequest wanted{
          at, {{format_number(value), "", true}}, "section-value", 5, value > 0 ? 6 : 2, false, 1};
      wanted.tolerance = 900;
      if (std::optional<Shape> text = place_label(wanted, taken)) {
        shapes.push_back(std::move(*text));
      }
    }
  }
  return group("section " + looks, std::move(shapes));
}

}  // namespace

double largest_of(const SectionPanel& panel) {
  const Range range = range_of(panel);
  return std::max(-range.low, range.high);
}

double length_of(const Sections& sections) {
  double length = 0;
  for (const SectionMember& member : sections.members) {
    length += member.length;
  }
  return length > 0 ? length : 1;
}

Figure draw_sections(const Sections& sections, const std::string& caption, Size size) {
  Figure figure;
  figure.title = caption;
  figure.shapes.push_back(label("caption", {0, 14}, Anchor::start, fitted(caption, size.width, 12, true)));
  const auto count = static_cast<double>(sections.panels.size());
  const double height = (size.height - kCaption - kRowGap * (count - 1)) / count;
  double top = kCaption;
  for (const SectionPanel& panel : sections.panels) {
    const Placed placed = placed_panel(panel, length_of(sections), top, height, size.width);
    figure.shapes.push_back(panel_shape(sections, placed, size));
    const Range range = range_of(panel);
    figure.description += (figure.description.empty() ? "" : " ") + panel.name + ": " +
                          format_number(range.low, 6) + " to " + with_unit(range.high, panel.unit, 6) + ".";
    top += height + kRowGap;
  }
  return figure;
}

}  // namespace snapthrough::api::plot
