#include <algorithm>
#include <cmath>
#include <set>

#include "api/plot/axes.h"
#include "api/plot/chart_marks.h"
#include "api/plot/figures.h"
#include "api/plot/geometry.h"
#include "api/plot/labels.h"
#include "api/plot/plot_error.h"
#include "api/plot/result.h"
#include "solver/numeric/bracket.h"
#include "solver/numeric/cubic.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

/// A vertex of a curve: a row of a branch, or a critical point between rows.
struct Vertex {
  double x = 0;
  double y = 0;
  double arc = 0;
  std::optional<double> negative;  ///< negative eigenvalues; nullopt: critical point; kNone: not counted
  std::optional<Point> rate = {};  ///< rate of x and y by arc length; nullopt: straight lines
  bool computed = true;            ///< an equilibrium was solved there
};

enum class Stability { stable, unstable, not_counted };

struct Curve {
  std::size_t branch = 0;
  std::vector<Vertex> vertices;
  std::vector<Stability> pieces;  ///< stability between vertices i and i + 1
};

/// Quantity on the horizontal axis.
struct Abscissa {
  std::string monitor;  ///< id of the monitor; empty: the arc length
  double sign = 1;      ///< -1: the axis shows minus the monitor
};

struct PathData {
  std::vector<Branch> branches;
  std::vector<CriticalPoint> points;
  std::vector<ContactEvent> events;
  Abscissa x;
  bool is_static = false;
};

/// Returns the values of a monitor on the axis; empty when there is no such monitor.
std::vector<double> values_of(const Monitors& monitors, const Abscissa& quantity) {
  const auto found = monitors.find(quantity.monitor);
  std::vector<double> values = found == monitors.end() ? std::vector<double>() : found->second;
  for (double& value : values) {
    value *= quantity.sign;
  }
  return values;
}

/// Returns the quantity at each row of a branch; empty when the branch lacks the monitor.
std::vector<double> values_of(const Branch& branch, const Abscissa& quantity) {
  return quantity.monitor.empty() ? branch.arc_length : values_of(branch.monitors, quantity);
}

/// Returns the rates of both axes by arc length at each row of a branch; empty where they are not known.
std::vector<Point> rates_of(const Branch& branch, const Abscissa& quantity) {
  std::vector<Point> rates;
  if (!branch.rates) {
    return rates;
  }
  const std::vector<double> along = values_of(branch.rates->monitors, quantity);
  for (std::size_t i = 0; i < branch.load_factor.size(); ++i) {
    if (quantity.monitor.empty()) {
      rates.push_back({1, branch.rates->load_factor[i]});
    } else if (i < along.size()) {
      rates.push_back({along[i], branch.rates->load_factor[i]});
    }
  }
  return rates;
}

double value_of(const CriticalPoint& point, const Abscissa& quantity) {
  if (quantity.monitor.empty()) {
    return point.arc_length;
  }
  const auto found = point.monitors.find(quantity.monitor);
  return found == point.monitors.end() ? kNone : quantity.sign * found->second;
}

/// Returns -1 when the monitor's mean on the primary path is negative, so that the path starts to the right.
double sign_of(const std::vector<Branch>& branches, const std::string& monitor) {
  double largest = 0;
  for (const Branch& branch : branches) {
    for (const double value : values_of(branch, {monitor, 1})) {
      largest = std::max(largest, std::abs(value));
    }
  }
  const std::vector<double> values = values_of(branches.front(), {monitor, 1});
  double mean = 0;
  for (const double value : values) {
    mean += value / static_cast<double>(values.size());
  }
  // A mean as small as rounding has no sign: only other branches move the monitor.
  return mean < -1e-9 * largest ? -1 : 1;
}

/// Returns the monitors' ids for an error message.
std::string monitor_names(const Monitors& monitors) {
  std::string all;
  for (const auto& [id, values] : monitors) {
    all += (all.empty() ? "" : ", ") + id;
  }
  return all.empty() ? "there are none" : "there are: " + all;
}

std::string first_monitor(const ResultInput& input, const Monitors& monitors) {
  if (input.model) {
    for (const ModelMonitor& monitor : input.model->monitors) {
      if (monitors.contains(monitor.id)) {
        return monitor.id;
      }
    }
  }
  return monitors.empty() ? "" : monitors.begin()->first;
}

Abscissa chosen_quantity(const ResultInput& input, const PlotRequest& request,
                         const std::vector<Branch>& branches) {
  if (request.over_arc_length) {
    return {};
  }
  const Monitors& monitors = branches.front().monitors;
  const std::string id = request.monitor.value_or(first_monitor(input, monitors));
  if (request.monitor && !monitors.contains(id)) {
    throw PlotError((input.result.find("static") ? "/static/monitors/" : "/branches/0/monitors/") +
                        escape_pointer_token(id),
                    "the result has no such monitor; " + monitor_names(monitors));
  }
  return id.empty() ? Abscissa{} : Abscissa{id, sign_of(branches, id)};
}

/// Throws the reason why the result has no path.
[[noreturn]] void fail_without_path(const Field& result) {
  if (const std::optional<Field> failure = result.find("failure")) {
    throw PlotError("/failure",
                    "the analysis failed before it had a path: " + text_or(*failure, "detail", ""));
  }
  throw PlotError("/branches", "the result has no path; an analysis of type path or static has one");
}

PathData read_path(const ResultInput& input, const PlotRequest& request) {
  PathData path{read_branches(input.result),
                read_critical_points(input.result),
                read_contact_events(input.result),
                {},
                false};
  if (std::all_of(path.branches.begin(), path.branches.end(),
                  [](const Branch& branch) { return branch.load_factor.empty(); })) {
    fail_without_path(input.result);
  }
  const std::optional<Field> branches = input.result.find("branches");
  path.is_static = !branches || branches->size() == 0;
  if (request.branch && *request.branch >= path.branches.size()) {
    throw PlotError("/branches/" + std::to_string(*request.branch),
                    "the result has branches 0 to " + std::to_string(path.branches.size() - 1));
  }
  path.x = chosen_quantity(input, request, path.branches);
  if (path.is_static && path.x.monitor.empty()) {
    path.points.clear();  // the axis counts rows; a critical point has no row
  }
  if (request.branch) {
    std::erase_if(path.points, [&](const CriticalPoint& one) { return one.branch != *request.branch; });
    std::erase_if(path.events, [&](const ContactEvent& one) { return one.branch != *request.branch; });
  }
  return path;
}

/// Returns the rows of a branch and its critical points in the order of arc length.
std::vector<Vertex> vertices_of(const PathData& path, std::size_t index) {
  const Branch& branch = path.branches[index];
  const std::vector<double> xs = values_of(branch, path.x);
  if (xs.empty()) {
    return {};
  }
  std::vector<Vertex> points;
  for (const CriticalPoint& point : path.points) {
    WorkLimit::poll();
    // a branch of cubics has rows at its critical points; a broken bifurcation lies beside it
    if (branch.rates && point.mark == Mark::broken_bifurcation) {
      continue;
    }
    if (!path.is_static && point.branch == index && std::isfinite(value_of(point, path.x))) {
      points.push_back({value_of(point, path.x), point.load_factor, point.arc_length, std::nullopt});
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Vertex& a, const Vertex& b) { return a.arc < b.arc; });
  const double near = 1e-9 * branch.arc_length.back();  // smaller differences of arc length are rounding
  const std::vector<Point> rates = rates_of(branch, path.x);
  std::vector<Vertex> merged;
  std::size_t next = 0;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const Vertex row{xs[i],
                     branch.load_factor[i],
                     branch.arc_length[i],
                     branch.negative_eigenvalues[i],
                     i < rates.size() ? std::optional(rates[i]) : std::nullopt,
                     std::binary_search(branch.computed.begin(), branch.computed.end(), i)};
    for (; next < points.size() && points[next].arc < row.arc - near; ++next) {
      if (!merged.empty() && merged.back().arc < points[next].arc - near) {
        merged.push_back(points[next]);
      }
    }
    merged.push_back(row);
    for (; next < points.size() && points[next].arc <= row.arc + near; ++next) {
      merged.back().negative = std::nullopt;
    }
  }
  return merged;
}

/// Returns the stability between vertices from the rows at both ends; between two critical points, that of
/// the piece before.
std::vector<Stability> pieces_of(const std::vector<Vertex>& vertices) {
  std::vector<Stability> pieces;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    const std::optional<double>& here = vertices[i].negative;
    const std::optional<double>& next = vertices[i + 1].negative;
    if (!here && !next) {
      pieces.push_back(i == 0 ? Stability::stable : pieces.back());
    } else if (std::isnan(here.value_or(0)) || std::isnan(next.value_or(0))) {
      pieces.push_back(Stability::not_counted);
    } else {
      pieces.push_back(std::max(here.value_or(0), next.value_or(0)) == 0 ? Stability::stable
                                                                         : Stability::unstable);
    }
  }
  return pieces;
}

/// Marks the pieces beyond the beginning of flutter as unstable: the number of negative eigenvalues of the
/// tangent stiffness does not show flutter.
void mark_flutter(const PathData& path, Curve& curve) {
  for (const CriticalPoint& point : path.points) {
    WorkLimit::poll();
    if (path.is_static || point.mark != Mark::flutter || point.branch != curve.branch) {
      continue;
    }
    const double near = 1e-9 * curve.vertices.back().arc;  // smaller differences of arc length are rounding
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
      if (curve.vertices[i].arc >= point.arc_length - near) {
        curve.pieces[i] = Stability::unstable;
      }
    }
  }
}

std::vector<Curve> curves_of(const PathData& path, const PlotRequest& request) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < path.branches.size(); ++i) {
    if (request.branch && *request.branch != i) {
      continue;
    }
    Curve curve{i, vertices_of(path, i), {}};
    curve.pieces = pieces_of(curve.vertices);
    if (!curve.vertices.empty()) {
      mark_flutter(path, curve);
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

const char* looks_of(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::unstable:
      return "unstable";
    case Stability::not_counted:
      return "untold";
  }
  return "";
}

/// Returns the point of a curve at a fraction of the arc length between two vertices.
Point between(const Vertex& a, const Vertex& b, double fraction) {
  if (!a.rate || !b.rate) {
    return {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
  }
  const double length = b.arc - a.arc;
  const CubicWeights h(fraction * length, length);
  return {h.a * a.x + h.da * a.rate->x + h.b * b.x + h.db * b.rate->x,
          h.a * a.y + h.da * a.rate->y + h.b * b.y + h.db * b.rate->y};
}

/// Returns the points of a curve from one vertex to another one: the vertices, and points of the cubics
/// between those with rates.
std::vector<Pixel> points_of(const Curve& curve, const Frame& frame, std::size_t first, std::size_t last) {
  constexpr int kParts = 16;  // lines for a cubic; thinned_points() takes away what nobody sees
  std::vector<Pixel> points{place(frame, curve.vertices[first].x, curve.vertices[first].y)};
  for (std::size_t i = first; i < last; ++i) {
    const Vertex& a = curve.vertices[i];
    const Vertex& b = curve.vertices[i + 1];
    WorkLimit::poll();
    for (int k = 1; a.rate && b.rate && b.arc > a.arc && k < kParts; ++k) {
      const Point at = between(a, b, static_cast<double>(k) / kParts);
      points.push_back(place(frame, at.x, at.y));
    }
    points.push_back(place(frame, b.x, b.y));
  }
  return points;
}

/// Draws each run of pieces with equal stability as one line; adjacent lines share a vertex.
void draw_curve(const Curve& curve, const Frame& frame, Occupancy& taken, std::vector<Shape>& shapes) {
  constexpr double kUnseen = 0.08;  // pixels; a bend of the line that twice as many pixels do not show either
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= curve.pieces.size(); ++i) {
    if (i < curve.pieces.size() && curve.pieces[i] == curve.pieces[begin]) {
      continue;
    }
    const std::vector<Pixel> points = thinned_points(points_of(curve, frame, begin, i), kUnseen);
    taken.add_line(points, 7);
    shapes.push_back(plot::path(
        std::string(curve.branch == 0 ? "path " : "path branch ") + looks_of(curve.pieces[begin]), points));
    begin = i;
  }
}

/// Returns the first point of a curve at a load factor; nullopt if there is none.
std::optional<Pixel> first_at_load(const Curve& curve, const Frame& frame, double load) {
  for (std::size_t i = 1; i < curve.vertices.size(); ++i) {
    const Vertex& a = curve.vertices[i - 1];
    const Vertex& b = curve.vertices[i];
    if ((a.y <= load && load <= b.y) || (b.y <= load && load <= a.y)) {
      const double share = a.y == load ? 0 : bisect(0.0, 1.0, 1e-9, [&](double fraction) {
        return (between(a, b, fraction).y < load) != (a.y < load);
      });
      return place(frame, between(a, b, share).x, load);
    }
  }
  return std::nullopt;
}

/// Returns the abscissa of a curve at an arc length.
double abscissa_at(const Curve& curve, double arc) {
  const auto beyond = std::find_if(curve.vertices.begin(), curve.vertices.end(),
                                   [arc](const Vertex& vertex) { return vertex.arc > arc; });
  if (beyond == curve.vertices.begin()) {
    return curve.vertices.front().x;
  }
  if (beyond == curve.vertices.end()) {
    return curve.vertices.back().x;
  }
  const Vertex& before = *(beyond - 1);
  return between(before, *beyond, (arc - before.arc) / (beyond->arc - before.arc)).x;
}

std::vector<PlacedMark> marks_of(const PathData& path, const ResultInput& input,
                                 const std::vector<Curve>& curves, const Frame& frame) {
  std::vector<PlacedMark> marks;
  for (const CriticalPoint& point : path.points) {
    const double x = value_of(point, path.x);
    if (std::isfinite(x)) {
      marks.push_back(placed_mark(point, place(frame, x, point.load_factor)));
    }
  }
  const std::optional<Softest> softest = read_softest(input.result);
  if (softest && !curves.empty() && curves.front().branch == 0) {
    if (const std::optional<Pixel> at = first_at_load(curves.front(), frame, softest->load_factor)) {
      marks.push_back(placed_mark(*softest, *at));
    }
  }
  const std::optional<FirstYield> yield = read_first_yield(input.result);
  if (yield && !curves.empty() && curves.front().branch == 0) {
    const double x = abscissa_at(curves.front(), yield->arc_length);
    marks.push_back(placed_mark(*yield, place(frame, x, yield->load_factor)));
  }
  return marks;
}

void draw_events(const PathData& path, const std::vector<Curve>& curves, const Frame& frame,
                 std::vector<Shape>& shapes) {
  std::vector<Shape> drawn;
  for (const ContactEvent& event : path.events) {
    WorkLimit::poll();
    const auto curve = std::find_if(curves.begin(), curves.end(),
                                    [&](const Curve& one) { return one.branch == event.branch; });
    if (curve != curves.end() && !path.is_static) {
      const double x = abscissa_at(*curve, event.arc_length);
      drawn.push_back(mark_shape(event.mark, place(frame, x, event.load_factor)));
    }
  }
  shapes.push_back(group("events", std::move(drawn)));
}

/// Draws the rows of a static analysis as dots; of a path a single row, or on request all that are computed.
void draw_rows(const PathData& path, const std::vector<Curve>& curves, const Frame& frame, bool points,
               std::vector<Shape>& shapes) {
  constexpr std::size_t kMost = 200;  // more dots overlap
  for (const Curve& curve : curves) {
    const bool alone = curve.vertices.size() == 1;
    const bool all = (path.is_static || alone) && curve.vertices.size() <= kMost;
    for (const Vertex& vertex : curve.vertices) {
      if (all || (points && vertex.computed)) {
        shapes.push_back(circle("row", place(frame, vertex.x, vertex.y), 2.5));
      }
    }
  }
}

std::vector<LegendEntry> legend_of(const PathData& path, const std::vector<Curve>& curves,
                                   const Field& result) {
  std::set<Stability> kinds;
  bool branches = false;
  for (const Curve& curve : curves) {
    kinds.insert(curve.pieces.begin(), curve.pieces.end());
    branches = branches || curve.branch != 0;
  }
  std::vector<LegendEntry> entries;
  const auto entry = [&](Stability kind, const char* text) {
    if (kinds.contains(kind)) {
      entries.push_back({text, std::string("path ") + looks_of(kind)});
    }
  };
  entry(Stability::stable, "stable");
  entry(Stability::unstable, "unstable");
  entry(Stability::not_counted, "stability not counted");
  if (branches) {
    entries.push_back({"branch", "path branch stable"});
  }
  std::set<Mark> marks;
  for (const CriticalPoint& point : path.points) {
    marks.insert(point.mark);
  }
  for (const ContactEvent& event : path.events) {
    marks.insert(event.mark);
  }
  if (!curves.empty() && curves.front().branch == 0) {
    if (read_softest(result)) {
      marks.insert(Mark::softest);
    }
    if (read_first_yield(result)) {
      marks.insert(Mark::first_yield);
    }
  }
  for (LegendEntry& mark : mark_entries(marks)) {
    entries.push_back(std::move(mark));
  }
  return entries;
}

std::string axis_name(const ResultInput& input, const PathData& path) {
  if (path.x.monitor.empty()) {
    return path.is_static ? "row" : "arc length of the path";
  }
  const ModelMonitor* monitor = input.model ? input.model->monitor(path.x.monitor) : nullptr;
  if (monitor != nullptr) {
    const Quantity quantity = monitor->component == "rotation" ? Quantity::rotation : Quantity::length;
    return name_with_unit(path.x.monitor + ", " + sense_of(*monitor, path.x.sign < 0),
                          unit_of(input.units, quantity));
  }
  return (path.x.sign < 0 ? "\u2212" : "") + path.x.monitor;
}

Frame frame_of(const ResultInput& input, const PathData& path, const std::vector<Curve>& curves, Size size,
               double legend) {
  Range x;
  Range y;
  const auto include = [&](double at, double load) {
    if (std::isfinite(at)) {
      x.include(at);
      y.include(load);
    }
  };
  for (const Curve& curve : curves) {
    for (const Vertex& vertex : curve.vertices) {
      include(vertex.x, vertex.y);
    }
  }
  for (const CriticalPoint& point : path.points) {
    include(value_of(point, path.x), point.load_factor);
  }
  const Range across = widened(x);
  const Range up = widened(y);
  Frame frame;
  frame.x_label = axis_name(input, path);
  frame.y_label = "load factor";
  frame.y = {up.low, up.high, std::max(60.0, size.height - 44), 14 + legend};
  const double left = room_for_numbers(frame);
  frame.x = {across.low, across.high, left, std::max(left + 28, size.width - 14)};
  return frame;
}

std::string description_of(const PathData& path, const std::vector<Curve>& curves) {
  return std::to_string(curves.size()) + (curves.size() == 1 ? " branch." : " branches.") +
         points_text(path.points);
}

}  // namespace

Figure path_figure(const ResultInput& input, const PlotRequest& request, Size size) {
  const PathData path = read_path(input, request);
  const std::vector<Curve> curves = curves_of(path, request);
  const std::vector<LegendEntry> legend = legend_of(path, curves, input.result);
  const Frame frame = frame_of(input, path, curves, size, legend_height(legend, size.width));
  Occupancy taken(size);
  keep_margins(frame, size, taken);
  Figure figure;
  figure.title = "Equilibrium path, load factor over " + frame.x_label;
  figure.description = description_of(path, curves);
  if (const std::optional<FirstYield> yield = read_first_yield(input.result)) {
    figure.description += " First yield at load factor " + format_number(yield->load_factor, 6) + ".";
  }
  figure.shapes.push_back(frame_shape(frame, size));
  for (const Curve& curve : curves) {
    draw_curve(curve, frame, taken, figure.shapes);
  }
  draw_rows(path, curves, frame, request.points, figure.shapes);
  draw_events(path, curves, frame, figure.shapes);
  draw_marks(marks_of(path, input, curves, frame), taken, figure.shapes);
  figure.shapes.push_back(legend_shape(legend, size.width));
  return figure;
}

}  // namespace snapthrough::api::plot
