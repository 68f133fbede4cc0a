#include "api/plot/marks.h"

#include "api/plot/labels.h"

namespace snapthrough::api::plot {
namespace {

struct Described {
  Mark mark;
  const char* name;
  const char* text;
};

constexpr Described kMarks[] = {{Mark::limit_max, "limit_max", "limit point"},
                                {Mark::limit_min, "limit_min", "limit point, minimum"},
                                {Mark::bifurcation, "bifurcation", "bifurcation"},
                                {Mark::broken_bifurcation, "broken_bifurcation", "broken bifurcation"},
                                {Mark::flutter, "flutter", "flutter"},
                                {Mark::capacity, "capacity", "capacity of supports"},
                                {Mark::softest, "softest", "softest point"},
                                {Mark::first_yield, "first_yield", "first yield"},
                                {Mark::closed, "closed", "contact made"},
                                {Mark::opened, "opened", "contact lost"}};

Shape polygon(std::string_view looks, Pixel at, std::vector<Pixel> corners) {
  for (Pixel& corner : corners) {
    corner = {at.x + corner.x, at.y + corner.y};
  }
  return path(looks, corners, true);
}

constexpr double kLeft = 62;     // pixels; left end of plots
constexpr double kNarrow = 420;  // pixels; narrower legends start at the left edge
constexpr double kRow = 18;

double sample_width(const LegendEntry& entry) { return entry.mark ? 18 : 30; }

struct Layout {
  std::vector<Pixel> places;
  std::size_t rows = 0;
};

Layout layout(const std::vector<LegendEntry>& entries, double width) {
  Layout result;
  const double left = width < kNarrow ? 4 : kLeft;
  double x = left;
  std::size_t row = 0;
  for (const LegendEntry& entry : entries) {
    const double wide = sample_width(entry) + text_width(entry.text) + 16;
    if (x > left && x + wide > width) {
      x = left;
      ++row;
    }
    result.places.push_back({x, 10 + kRow * static_cast<double>(row)});
    x += wide;
  }
  result.rows = entries.empty() ? 0 : row + 1;
  return result;
}

}  // namespace

std::optional<Mark> mark_named(std::string_view name) {
  for (const Described& one : kMarks) {
    if (one.name == name) {
      return one.mark;
    }
  }
  return std::nullopt;
}

const char* mark_text(Mark mark) { return kMarks[static_cast<std::size_t>(mark)].text; }

Shape mark_shape(Mark mark, Pixel at) {
  switch (mark) {
    case Mark::limit_max:
      return polygon("mark limit", at, {{0, -6.5}, {6, 4.5}, {-6, 4.5}});
    case Mark::limit_min:
      return polygon("mark limit", at, {{0, 6.5}, {6, -4.5}, {-6, -4.5}});
    case Mark::bifurcation:
      return polygon("mark bifurcation", at, {{0, -7}, {6, 0}, {0, 7}, {-6, 0}});
    case Mark::broken_bifurcation:
      return polygon("mark broken", at, {{0, -7}, {6, 0}, {0, 7}, {-6, 0}});
    case Mark::flutter:
      return polygon("mark flutter", at, {{-6, -6.5}, {6, -6.5}, {-6, 6.5}, {6, 6.5}});
    case Mark::capacity:
      return polygon("mark limit", at, {{-6, -5}, {6, -5}, {6, -1}, {-6, -1}});
    case Mark::softest:
      return polygon("mark softest", at, {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}});
    case Mark::first_yield:
      return polygon("mark yield", at, {{-4.5, -6}, {6.5, 0}, {-4.5, 6}});
    case Mark::closed:
      return circle("mark event", at, 3);
    case Mark::opened:
      return circle("mark event open", at, 3);
  }
  return group("mark", {});
}

double legend_height(const std::vector<LegendEntry>& entries, double width) {
  return kRow * static_cast<double>(layout(entries, width).rows);
}

Shape legend_shape(const std::vector<LegendEntry>& entries, double width, double top) {
  const Layout places = layout(entries, width);
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Pixel at{places.places[i].x, places.places[i].y + top};
    const LegendEntry& entry = entries[i];
    shapes.push_back(entry.mark ? mark_shape(*entry.mark, {at.x + 6, at.y})
                                : group(entry.group, {line(entry.line, at, {at.x + 24, at.y})}));
    shapes.push_back(label("legend-text", {at.x + sample_width(entry), at.y + 4}, Anchor::start,
                           fitted(entry.text, width - sample_width(entry) - at.x)));
  }
  return group("legend", std::move(shapes));
}

std::vector<LegendEntry> mark_entries(const std::set<Mark>& marks) {
  std::vector<LegendEntry> entries;
  entries.reserve(marks.size());
  for (const Mark mark : marks) {
    entries.push_back({mark_text(mark), "", "sample", mark});
  }
  return entries;
}

}  // namespace snapthrough::api::plot
