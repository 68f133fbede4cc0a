#include <algorithm>
#include <cmath>
#include <limits>

#include "api/plot/axes.h"
#include "api/plot/contours.h"
#include "api/plot/figures.h"
#include "api/plot/labels.h"
#include "api/plot/numbers.h"
#include "api/plot/plot_error.h"
#include "api/plot/sweep_axes.h"
#include "api/plot/table.h"

namespace snapthrough::api::plot {
namespace {

constexpr std::size_t kBands = 12;      // CSS classes band-0 ... band-11
constexpr std::size_t kForHeatmap = 6;  // up to six values of a parameter are drawn as curves
constexpr std::size_t kNoRow = std::numeric_limits<std::size_t>::max();
constexpr double kFailedHatch = 6;  // pixels between hatch lines

/// A table's rows as cells of a rectangular grid, or as dots when they do not form a grid.
struct Map {
  const Table& table;
  const Column& x;
  const Column& y;
  std::vector<double> xs, ys;      ///< distinct values, increasing
  std::vector<std::size_t> cells;  ///< row of each cell, x varying fastest, or kNoRow; empty: no grid
  std::vector<double> levels;      ///< bounds between bands, increasing
  Frame frame;
  std::vector<double> x_edges, y_edges;  ///< cell bounds in pixels, one more than values
};

/// Returns round values that divide the range of a column into at most kBands bands.
std::vector<double> band_levels(const Column& output) {
  if (output.names) {
    std::vector<double> levels;
    for (std::size_t i = 1; i < output.names->size(); ++i) {
      levels.push_back(static_cast<double>(i) - 0.5);
    }
    return levels;
  }
  Range range;
  for (const double value : output.values) {
    range.include(value);
  }
  if (range.empty() || !(range.high > range.low)) {
    return {};
  }
  const double step = round_step(range.high - range.low, 8);
  const double first = std::floor(range.low / step) + 1;
  std::vector<double> levels;
  for (std::size_t i = 0; i < kBands - 1; ++i) {
    const double level = multiple(first + static_cast<double>(i), step);
    if (!(level < range.high)) {
      break;
    }
    levels.push_back(level);
  }
  return levels;
}

/// Returns the CSS class of a value's band; the bands use the whole range of colours.
std::string band_looks(const Map& map, double value) {
  if (!std::isfinite(value)) {
    return "no-value";
  }
  const auto band =
      static_cast<double>(std::upper_bound(map.levels.begin(), map.levels.end(), value) - map.levels.begin());
  const double share = map.levels.empty() ? 0.5 : band / static_cast<double>(map.levels.size());
  return "band-" + std::to_string(static_cast<int>(std::round(share * (kBands - 1))));
}

/// Returns the index of a value in a sorted list.
std::size_t index_in(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

std::vector<std::size_t> cells_of(const Map& map) {
  const std::size_t columns = map.xs.size();
  std::size_t rows = 0;
  for (std::size_t row = 0; row < map.x.values.size(); ++row) {
    rows += std::isfinite(map.x.values[row]) && std::isfinite(map.y.values[row]) ? 1 : 0;
  }
  if (rows == 0) {
    throw PlotError("/rows", "has no row with a value of both " + map.x.name + " and " + map.y.name);
  }
  if (columns * map.ys.size() > 2 * rows) {
    return {};  // less than half of the cells have a row: no grid
  }
  std::vector<std::size_t> cells(columns * map.ys.size(), kNoRow);
  for (std::size_t row = 0; row < map.x.values.size(); ++row) {
    if (!std::isfinite(map.x.values[row]) || !std::isfinite(map.y.values[row])) {
      continue;
    }
    std::size_t& cell =
        cells[index_in(map.ys, map.y.values[row]) * columns + index_in(map.xs, map.x.values[row])];
    if (cell != kNoRow) {
      throw PlotError("/rows/" + std::to_string(row),
                      "has the same " + map.x.name + " and " + map.y.name +
                          " as another row: choose values of the other parameters (where)");
    }
    cell = row;
  }
  return cells;
}

/// Returns a scale that extends half a cell beyond the extreme values.
Scale cell_scale(const Column& column, const std::vector<double>& values, double start, double end) {
  if (column.names || values.size() < 2) {
    return axis_of(column, start, end, false);
  }
  const std::size_t n = values.size();
  if (is_logarithmic(column)) {
    return {values[0] * std::sqrt(values[0] / values[1]),
            values[n - 1] * std::sqrt(values[n - 1] / values[n - 2]), start, end, true};
  }
  return {values[0] - (values[1] - values[0]) / 2, values[n - 1] + (values[n - 1] - values[n - 2]) / 2, start,
          end};
}

/// Returns cell bounds in pixels, half way between adjacent values.
std::vector<double> edges_of(const Scale& scale, const std::vector<double>& values) {
  std::vector<double> edges{scale.start};
  for (std::size_t i = 1; i < values.size(); ++i) {
    edges.push_back((place(scale, values[i - 1]) + place(scale, values[i])) / 2);
  }
  edges.push_back(scale.end);
  return edges;
}

/// Returns the text of the upper bound of band i, or the band's name for a column of texts.
std::string level_text(const Map& map, std::size_t i) {
  return map.table.output.names ? (*map.table.output.names)[i] : format_number(map.levels[i]);
}

double bar_width(const Map& map) {
  double widest = 0;
  const std::size_t count = map.levels.size() + (map.table.output.names ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    widest = std::max(widest, text_width(level_text(map, i)));
  }
  return 62 + std::min(widest, 160.0);
}

void set_frame(Map& map, Size size, double top) {
  constexpr std::size_t kFewValues = 10;
  Frame& frame = map.frame;
  const auto few = [](const Column& column, const std::vector<double>& values) {
    return column.names || values.size() > kFewValues ? std::nullopt : std::optional(values);
  };
  frame.y = cell_scale(map.y, map.ys, std::max(60.0, size.height - 44), top);
  frame.y_names = map.y.names;
  frame.y_name_room = std::min(160.0, 0.2 * size.width);
  frame.y_values = few(map.y, map.ys);
  frame.y_label = map.y.label;
  frame.x_label = map.x.label;
  const double left = std::max(66.0, room_for_numbers(frame));
  frame.x = cell_scale(map.x, map.xs, left, std::max(left + 28, size.width - bar_width(map)));
  frame.x_names = map.x.names;
  frame.x_values = few(map.x, map.xs);
  map.x_edges = edges_of(frame.x, map.xs);
  map.y_edges = edges_of(frame.y, map.ys);
}

/// Returns the CSS class of a cell; "" for a cell without row.
std::string cell_looks(const Map& map, std::size_t cell) {
  const std::size_t row = map.cells[cell];
  if (row == kNoRow) {
    return "";
  }
  return !map.table.errors[row].empty() ? "failed-cell"
                                        : "band " + band_looks(map, map.table.output.values[row]);
}

/// Returns path data of hatch lines at 45 degrees inside a box.
std::string hatch_of(const Box& box) {
  std::string text;
  const double from = std::ceil((box.left + box.top) / kFailedHatch);
  for (double k = from; k * kFailedHatch < box.right + box.bottom; ++k) {
    const double sum = k * kFailedHatch;
    const double left = std::max(box.left, sum - box.bottom);
    const double right = std::min(box.right, sum - box.top);
    if (right > left) {
      const Pixel ends[] = {{left, sum - left}, {right, sum - right}};
      text += path_data(ends);
    }
  }
  return text;
}

std::string box_data(const Box& box) {
  return "M" + coordinate(box.left) + " " + coordinate(box.bottom) + "H" + coordinate(box.right) + "V" +
         coordinate(box.top) + "H" + coordinate(box.left) + "Z";
}

/// Draws cells, adjacent equal ones of a grid row as one rectangle, with hatch over failed cells.
std::vector<Shape> cell_shapes(const Map& map) {
  std::map<std::string, std::string> data;
  std::string hatches;
  const std::size_t columns = map.xs.size();
  for (std::size_t j = 0; j < map.ys.size(); ++j) {
    std::size_t begin = 0;
    std::string looks = cell_looks(map, j * columns);
    for (std::size_t i = 1; i <= columns; ++i) {
      const std::string next = i < columns ? cell_looks(map, j * columns + i) : std::string("\n");
      if (next == looks) {
        continue;
      }
      const Box box{map.x_edges[begin], map.y_edges[j + 1], map.x_edges[i], map.y_edges[j]};
      if (!looks.empty()) {
        data[looks] += box_data(box);
      }
      if (looks == "failed-cell") {
        hatches += hatch_of(box);
      }
      begin = i;
      looks = next;
    }
  }
  std::vector<Shape> shapes;
  shapes.reserve(data.size() + 1);
  for (auto& [looks, d] : data) {
    shapes.push_back(path_of(looks, std::move(d)));
  }
  shapes.push_back(path_of("failed-hatch", hatches));
  return shapes;
}

/// Draws rows that do not form a grid as dots, and failed ones as crosses.
std::vector<Shape> dot_shapes(const Map& map) {
  std::vector<Shape> shapes;
  std::string failed;
  for (std::size_t row = 0; row < map.x.values.size(); ++row) {
    if (!std::isfinite(map.x.values[row]) || !std::isfinite(map.y.values[row])) {
      continue;
    }
    const Pixel at = place(map.frame, map.x.values[row], map.y.values[row]);
    if (!map.table.errors[row].empty()) {
      failed += cross(at, 4);
    } else {
      shapes.push_back(circle("dot " + band_looks(map, map.table.output.values[row]), at, 4.5));
    }
  }
  shapes.push_back(path_of("mark failed", failed));
  return shapes;
}

/// Draws contour lines between cell centres, labelled with their values when there is room.
std::vector<Shape> contour_shapes(const Map& map, Size size) {
  std::vector<Shape> shapes;
  if (map.cells.empty() || map.xs.size() < 3 || map.ys.size() < 3 || map.table.output.names) {
    return shapes;
  }
  Grid grid;
  for (const double x : map.xs) {
    grid.x.push_back(place(map.frame.x, x));
  }
  for (const double y : map.ys) {
    grid.y.push_back(place(map.frame.y, y));
  }
  for (const std::size_t row : map.cells) {
    grid.values.push_back(row == kNoRow ? kNone : map.table.output.values[row]);
  }
  Occupancy taken(size);
  taken.add_box({0, 0, map.frame.x.start, size.height});
  taken.add_box({map.frame.x.end, 0, size.width, size.height});
  taken.add_box({0, map.frame.y.start, size.width, size.height});
  taken.add_box({0, 0, size.width, map.frame.y.end});
  std::vector<Shape> texts;
  const std::vector<std::vector<Segment>> all = contours(grid, map.levels);
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::string data;
    for (const auto& [from, to] : all[k]) {
      const Pixel ends[] = {from, to};
      data += path_data(ends);
    }
    if (all[k].size() > 4) {
      const bool dark = static_cast<double>(k) / static_cast<double>(all.size()) * (kBands - 1) > 5.5;
      const LabelRequest wanted{all[k][all[k].size() / 2].first,
                                {{format_number(map.levels[k]), "", false}},
                                dark ? "contour-text on-dark" : "contour-text",
                                2};
      if (std::optional<Shape> text = place_label(wanted, taken)) {
        texts.push_back(std::move(*text));
      }
    }
    shapes.push_back(path_of("contour", data));
  }
  append(shapes, std::move(texts));
  return shapes;
}

/// Draws the colour bar: bands with the values of their bounds, or with their names.
std::vector<Shape> bar_shapes(const Map& map, Size size) {
  const double x = map.frame.x.end + 16;
  const double bottom = map.frame.y.start;
  const bool names = map.table.output.names.has_value();
  const auto count = static_cast<double>(map.levels.size() + 1);
  const double step = std::min(22.0, (bottom - map.frame.y.end - 4) / count);
  std::vector<Shape> shapes;
  for (std::size_t band = 0; band <= map.levels.size(); ++band) {
    const double low = bottom - static_cast<double>(band) * step;
    const double value =
        band < map.levels.size() ? map.levels[band] - (names ? 0.25 : 0) : std::numeric_limits<double>::max();
    const std::string looks =
        band < map.levels.size() ? band_looks(map, std::nextafter(value, -std::numeric_limits<double>::max()))
                                 : band_looks(map, value);
    shapes.push_back(rectangle("band " + looks, {x, low - step, x + 14, low}));
    if (names || band < map.levels.size()) {
      shapes.push_back(label("tick", {x + 20, low - (names ? step / 2 : step) + 4}, Anchor::start,
                             fitted(level_text(map, band), 160)));
    }
  }
  shapes.push_back(upright_label("axis-label", {size.width - 6, (bottom + map.frame.y.end) / 2},
                                 fitted(map.table.output.label, bottom - map.frame.y.end)));
  return shapes;
}

/// Draws the key of failed cells and cells without value above the map.
std::vector<Shape> key_shapes(const Map& map, const std::string& failures, Size size) {
  std::vector<Shape> shapes;
  double x = map.frame.x.start;
  const auto add = [&](const std::string& looks, const std::string& text) {
    const Box box{x, 4, x + 18, 16};
    shapes.push_back(path_of(looks, box_data(box)));
    if (looks == "failed-cell") {
      shapes.push_back(path_of("failed-hatch", hatch_of(box)));
    }
    const std::string shown = fitted(text, std::max(20.0, size.width - x - 24));
    shapes.push_back(label("muted", {x + 24, 14}, Anchor::start, shown));
    x += 24 + text_width(shown) + 18;
  };
  if (!failures.empty()) {
    add("failed-cell", failures);
  }
  bool without = false;
  for (std::size_t row = 0; row < map.table.errors.size(); ++row) {
    without = without || (map.table.errors[row].empty() && !std::isfinite(map.table.output.values[row]));
  }
  if (without && !map.cells.empty()) {
    add("band no-value", "no value");
  }
  return shapes;
}

}  // namespace

bool is_for_heatmap(const Field& document) {
  const Table table = read_table(document, PlotRequest());
  const std::vector<const Column*> varied = varied_parameters(table);
  return varied.size() == 2 && varied[1]->distinct() > kForHeatmap;
}

Figure heatmap_figure(const Field& document, const PlotRequest& request, Size size) {
  const Table table = read_table(document, request);
  const ChosenParameters chosen = default_parameters(table, request);
  if (chosen.by == nullptr) {
    throw PlotError("/columns", "has one parameter with several values; a map needs two: plot a sweep");
  }
  if (table.output.names && table.output.names->size() > kBands) {
    throw PlotError("/columns", "has more than 12 different texts in " + table.output.name +
                                    ", which a map cannot tell apart");
  }
  Map map{table,
          *chosen.x,
          *chosen.by,
          distinct_values(chosen.x->values),
          distinct_values(chosen.by->values),
          {},
          {},
          {},
          {},
          {}};
  map.cells = cells_of(map);
  map.levels = band_levels(table.output);
  const std::string failures = failure_text(table.errors);
  set_frame(map, size, 28);
  Figure figure;
  figure.title = table.output.label + " over " + map.x.label + " and " + map.y.label;
  figure.description = std::to_string(map.xs.size()) + " by " + std::to_string(map.ys.size()) + " values." +
                       (failures.empty() ? "" : " " + failures + ".");
  figure.shapes.push_back(frame_shape(map.frame, size));
  figure.shapes.push_back(group("cells", map.cells.empty() ? dot_shapes(map) : cell_shapes(map)));
  figure.shapes.push_back(group("contours", contour_shapes(map, size)));
  figure.shapes.push_back(group("bar", bar_shapes(map, size)));
  figure.shapes.push_back(group("key", key_shapes(map, failures, size)));
  return figure;
}

}  // namespace snapthrough::api::plot
