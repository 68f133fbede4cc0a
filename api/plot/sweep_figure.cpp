#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "api/plot/axes.h"
#include "api/plot/figures.h"
#include "api/plot/labels.h"
#include "api/plot/marks.h"
#include "api/plot/numbers.h"
#include "api/plot/sweep_axes.h"
#include "api/plot/sweep_breaks.h"
#include "api/plot/table.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr std::size_t kNamed = 16;   // largest number of curves with dots and legend
constexpr std::size_t kColours = 6;  // further curves repeat the colours
constexpr double kTolerance = 0.25;  // pixels; deviation of a thinned line
constexpr double kCrowdedTolerance = 0.75;

/// Rows with equal values of the series' parameters, sorted by x.
struct Curve {
  std::string name;  ///< for the legend; empty beyond the first kNamed curves
  std::vector<std::size_t> rows;
};

/// Returns the parameters whose values distinguish curves: `by` and all other varied ones except x.
std::vector<const Column*> series_of(const Table& table, const PlotRequest& request, const Column& x) {
  std::vector<const Column*> series;
  if (request.by) {
    series.push_back(&parameter(table, *request.by));
  }
  for (const Column* column : varied_parameters(table)) {
    if (column != &x && (series.empty() || column != series.front()) && column->distinct() > 1) {
      series.push_back(column);
    }
  }
  return series;
}

/// Returns the values that a row's curve has in common, such as "k = 10, feet = clamped".
std::string curve_name(const std::vector<const Column*>& series, std::size_t row) {
  std::string name;
  for (const Column* column : series) {
    name += (name.empty() ? "" : ", ") + column->name + " = " + value_text(*column, column->values[row]);
  }
  return name;
}

std::vector<Curve> curves_of(const std::vector<const Column*>& series, const Column& x) {
  std::map<std::vector<double>, std::size_t> known;
  std::vector<Curve> curves;
  for (std::size_t row = 0; row < x.values.size(); ++row) {
    WorkLimit::poll();
    std::vector<double> key;
    for (const Column* column : series) {
      const double value = column->values[row];
      key.push_back(std::isfinite(value) ? value : -1e300);  // rows without value form one curve
    }
    const auto [place, is_new] = known.emplace(std::move(key), curves.size());
    if (is_new) {
      curves.push_back({curves.size() < kNamed ? curve_name(series, row) : "", {}});
    }
    if (std::isfinite(x.values[row])) {
      curves[place->second].rows.push_back(row);
    }
  }
  for (Curve& curve : curves) {
    std::stable_sort(curve.rows.begin(), curve.rows.end(),
                     [&](std::size_t a, std::size_t b) { return x.values[a] < x.values[b]; });
  }
  return curves;
}

std::vector<LegendEntry> legend_of(const std::vector<Curve>& curves, const Column& y) {
  std::vector<LegendEntry> entries;
  if (curves.size() < 2 || curves.size() > kNamed) {
    return entries;
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const bool empty = std::none_of(curves[i].rows.begin(), curves[i].rows.end(),
                                    [&](std::size_t row) { return std::isfinite(y.values[row]); });
    entries.push_back({curves[i].name + (empty ? " (no value)" : ""), "series-line",
                       "series series-" + std::to_string(i % kColours)});
  }
  return entries;
}

/// Returns path data of a curve, interrupted at points without place and thinned between them.
std::string line_data(const std::vector<Pixel>& points, double tolerance) {
  std::string text;
  std::vector<Pixel> part;
  const auto finish = [&] {
    text += path_data(thinned_points(part, tolerance));
    part.clear();
  };
  for (const Pixel& point : points) {
    if (std::isfinite(point.y)) {
      part.push_back(point);
    } else {
      finish();
    }
  }
  finish();
  return text;
}

/// Returns where a row is drawn; no place where it has no value.
Pixel place_of(const Frame& frame, const Column& x, const Column& y, std::size_t row) {
  const bool shown = std::isfinite(y.values[row]) && !(frame.y.log && y.values[row] <= 0);
  return shown ? place(frame, x.values[row], y.values[row]) : Pixel{0, kNone};
}

/// Draws a curve, interrupted between pieces, and adds its breaks.
Shape curve_shape(const Curve& curve, std::size_t number, bool crowded, const Frame& frame,
                  const Table& table, const Column& x, std::vector<SweepBreak>& breaks) {
  constexpr std::size_t kMostDots = 80;  // more dots overlap
  std::vector<Pixel> points;
  std::vector<Pixel> seen;
  std::optional<std::size_t> before;
  for (const std::size_t row : curve.rows) {
    const Pixel here = place_of(frame, x, table.output, row);
    if (before && is_break(table, *before, row)) {
      breaks.push_back({points.back(), here, change_at(table, *before, row)});
      points.push_back({0, kNone});
    }
    points.push_back(here);
    if (std::isfinite(here.y)) {
      seen.push_back(here);
    }
    before = row;
  }
  std::vector<Shape> shapes{
      path_of("series-line", line_data(points, crowded ? kCrowdedTolerance : kTolerance))};
  for (std::size_t i = 0; !crowded && seen.size() <= kMostDots && i < seen.size(); ++i) {
    shapes.push_back(circle("series-dot", seen[i], 2.4));
  }
  return group("series series-" + std::to_string(number % kColours), std::move(shapes));
}

/// Draws a cross on the axis for failed points, one cross for each pixel.
Shape failed_shape(const Table& table, const Column& x, const Frame& frame) {
  std::set<long> seen;
  std::string data;
  for (std::size_t row = 0; row < x.values.size(); ++row) {
    if (table.errors[row].empty() || !std::isfinite(x.values[row])) {
      continue;
    }
    const double pixel = std::round(place(frame.x, x.values[row]));
    if (seen.insert(static_cast<long>(pixel)).second) {
      data += cross({pixel, frame.y.start - 7}, 4);
    }
  }
  return path_of("mark failed", data);
}

/// Returns where each curve is drawn, for labels to keep away from.
std::vector<std::vector<Pixel>> curve_pixels(const std::vector<Curve>& curves, const Table& table,
                                             const Column& x, const Frame& frame) {
  std::vector<std::vector<Pixel>> all;
  for (const Curve& curve : curves) {
    std::vector<Pixel> points;
    for (const std::size_t row : curve.rows) {
      if (const Pixel here = place_of(frame, x, table.output, row); std::isfinite(here.y)) {
        points.push_back(here);
      }
    }
    all.push_back(std::move(points));
  }
  return all;
}

Frame frame_of(const Column& x, const Column& y, Size size, double top) {
  Frame frame;
  frame.y = axis_of(y, std::max(60.0, size.height - 44), top, false);
  frame.y_names = y.names;
  frame.y_name_room = std::min(160.0, 0.2 * size.width);
  frame.y_label = y.label;
  frame.x_label = x.label;
  frame.x_names = x.names;
  frame.x = axis_of(x, std::max(66.0, room_for_numbers(frame)), std::max(110.0, size.width - 28), true);
  return frame;
}

}  // namespace

Figure sweep_figure(const Field& document, const PlotRequest& request, Size size) {
  const Table table = read_table(document, request);
  const Column& x = request.x ? parameter(table, *request.x) : *default_parameters(table, request).x;
  const std::vector<Curve> curves = curves_of(series_of(table, request, x), x);
  const std::string failures = failure_text(table.errors);
  const std::vector<LegendEntry> legend = legend_of(curves, table.output);
  const double under_failures = failures.empty() ? 0 : 18;
  const Frame frame =
      frame_of(x, table.output, size, 12 + under_failures + legend_height(legend, size.width));
  Figure figure;
  figure.title = table.output.label + " over " + x.label;
  figure.description = std::to_string(x.values.size()) + " points, " + std::to_string(curves.size()) +
                       (curves.size() == 1 ? " curve." : " curves.") +
                       (failures.empty() ? "" : " " + failures + ".");
  figure.shapes.push_back(frame_shape(frame, size));
  std::vector<SweepBreak> breaks;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    figure.shapes.push_back(curve_shape(curves[i], i, curves.size() > kNamed, frame, table, x, breaks));
  }
  figure.description += breaks_text(breaks);
  figure.shapes.push_back(failed_shape(table, x, frame));
  figure.shapes.push_back(breaks_shape(breaks, curve_pixels(curves, table, x, frame), size,
                                       {frame.x.start, frame.y.end, frame.x.end, frame.y.start}));
  figure.shapes.push_back(legend_shape(legend, size.width, under_failures));
  if (!failures.empty()) {
    figure.shapes.push_back(failure_note(failures, size));
  }
  return figure;
}

}  // namespace snapthrough::api::plot
