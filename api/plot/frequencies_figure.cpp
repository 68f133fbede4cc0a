#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "api/plot/axes.h"
#include "api/plot/chart_marks.h"
#include "api/plot/figures.h"
#include "api/plot/labels.h"
#include "api/plot/numbers.h"
#include "api/plot/plot_error.h"
#include "api/plot/result.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

/// A natural motion vibrates, is one of a pair whose vibrations grow, or grows without vibrating.
enum class MotionKind { vibrates, flutters, diverges };

struct Motion {
  MotionKind kind = MotionKind::vibrates;
  /// Circular frequency in radians per time; of a motion that diverges minus the square root of -omega
  /// squared.
  double omega = 0;
};

/// Motions at a load factor, in the order of the result; empty where the result has none.
struct Row {
  double load_factor = 0;
  std::vector<Motion> motions;
};

/// Rows of a branch or of another analysis; lines join each row to the next one.
struct Series {
  std::size_t branch = 0;  ///< index of the branch; 0 for the rows of other analyses
  std::vector<Row> rows;
};

struct FrequencyData {
  std::vector<Series> series;
  std::vector<CriticalPoint> points;
  bool few_rows = false;  ///< rows of load factors that were asked for, not of a path
};

std::vector<Motion> read_motions(const Field& frequencies) {
  constexpr double kRounding = 1e-9;  // times the largest omega squared: rounding of motions that are free
  const Field list = frequencies.at("omega_squared");
  const std::vector<double> squares = list.numbers();
  const std::optional<Field> parts = frequencies.find("imaginary");
  const std::vector<double> imaginary =
      parts ? parts->numbers(squares.size()) : std::vector<double>(squares.size());
  double largest = 0;
  for (const double square : squares) {
    largest = std::max(largest, std::abs(square));
  }
  std::vector<Motion> motions;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double square = squares[i];
    if (imaginary[i] != 0) {
      const double real = 0.5 * (std::hypot(square, imaginary[i]) + square);
      motions.push_back({MotionKind::flutters, std::sqrt(std::max(0.0, real))});
    } else {
      motions.push_back({square < -kRounding * largest ? MotionKind::diverges : MotionKind::vibrates,
                         std::copysign(std::sqrt(std::abs(square)), square)});
    }
  }
  return motions;
}

/// Reads the computed rows of a branch or of a static analysis: others have no frequencies, and are no gaps.
std::vector<Row> read_rows(const Field& table, const Branch& branch) {
  std::vector<Row> rows;
  const std::optional<Field> list = table.find("frequencies");
  const std::size_t count = list ? list->size() : 0;
  if (list && count != branch.load_factor.size()) {
    list->fail("must have as many values as load_factor");
  }
  const bool tells_computed = table.find("computed").has_value();
  for (std::size_t i = 0; i < count; ++i) {
    const bool computed =
        !tells_computed || std::binary_search(branch.computed.begin(), branch.computed.end(), i);
    if (computed) {
      const Field one = list->item(i);
      rows.push_back(
          {branch.load_factor[i], one.json().is_null() ? std::vector<Motion>() : read_motions(one)});
    }
  }
  return rows;
}

/// Reads the load factors of a vibration analysis, sorted.
std::vector<Row> read_vibrations(const Field& list) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Field one = list.item(i);
    rows.push_back({one.at("load_factor").number(), read_motions(one.at("frequencies"))});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.load_factor < b.load_factor; });
  return rows;
}

/// Throws the reason why a result has no frequencies.
[[noreturn]] void fail_without_frequencies(const Field& result, bool has_branches) {
  constexpr const char* kAsk =
      "the result has no frequencies along it; analysis.output.frequencies of the request asks for them";
  if (has_branches) {
    throw PlotError("/branches/0/frequencies", kAsk);
  }
  const std::optional<Field> table = result.find("static");
  if (table && table->at("load_factor").size() > 0 && !result.find("vibrations")) {
    throw PlotError("/static/frequencies", kAsk);
  }
  if (const std::optional<Field> failure = result.find("failure")) {
    throw PlotError("/failure",
                    "the analysis failed before it had frequencies: " + text_or(*failure, "detail", ""));
  }
  throw PlotError(
      "/vibrations",
      "the result has no frequencies; an analysis of type vibration has them, and one of type path "
      "or static that asks for them by analysis.output.frequencies");
}

bool has_motions(const Series& series) {
  return std::any_of(series.rows.begin(), series.rows.end(),
                     [](const Row& row) { return !row.motions.empty(); });
}

/// Reads the frequencies of a vibration analysis, else those of the branches, else those of a static
/// analysis.
FrequencyData read_frequencies(const Field& result) {
  FrequencyData data;
  const std::optional<Field> vibrations = result.find("vibrations");
  const std::optional<Field> branches = result.find("branches");
  const bool has_branches = branches && branches->size() > 0;
  data.few_rows = !has_branches;
  if (vibrations && vibrations->size() > 0) {
    data.few_rows = true;
    data.series.push_back({0, read_vibrations(*vibrations)});
  } else if (has_branches || result.find("static")) {
    const std::vector<Branch> tables = read_branches(result);
    for (std::size_t i = 0; i < tables.size(); ++i) {
      data.series.push_back(
          {i, read_rows(has_branches ? branches->item(i) : result.at("static"), tables[i])});
    }
  }
  if (std::none_of(data.series.begin(), data.series.end(), has_motions)) {
    fail_without_frequencies(result, has_branches);
  }
  data.points = read_critical_points(result);
  return data;
}

/// Returns the place of a critical point in chart values: of flutter the first motion that flutters at its
/// load factor or, since the critical load is rounded, in the row beyond; of others the motion of the lowest
/// frequency. Nullopt where no row has the load factor, or the point lies beside the path.
std::optional<Point> place_of(const FrequencyData& data, const CriticalPoint& point) {
  if (point.mark == Mark::broken_bifurcation || point.mark == Mark::capacity) {
    return std::nullopt;
  }
  const auto series = std::find_if(data.series.begin(), data.series.end(),
                                   [&](const Series& one) { return one.branch == point.branch; });
  if (series == data.series.end()) {
    return std::nullopt;
  }
  const std::vector<Row>& rows = series->rows;
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& one) {
    WorkLimit::poll();
    return std::abs(one.load_factor - point.load_factor) <= 1e-9 * std::abs(point.load_factor);
  });
  if (row == rows.end() || row->motions.empty()) {
    return std::nullopt;
  }
  const std::vector<Motion>& motions = row->motions;
  if (point.mark != Mark::flutter) {
    const auto lowest = std::min_element(
        motions.begin(), motions.end(),
        [](const Motion& a, const Motion& b) { return std::abs(a.omega) < std::abs(b.omega); });
    return Point{row->load_factor, lowest->omega};
  }
  for (auto at = row; at != rows.end() && at <= row + 1; ++at) {
    const auto found = std::find_if(at->motions.begin(), at->motions.end(),
                                    [](const Motion& one) { return one.kind == MotionKind::flutters; });
    const auto number = static_cast<std::size_t>(found - at->motions.begin());
    if (found != at->motions.end() && number < motions.size()) {
      return Point{row->load_factor, motions[number].omega};
    }
  }
  return std::nullopt;
}

/// Returns whether a motion of the data is of a kind.
bool has_kind(const FrequencyData& data, MotionKind kind) {
  for (const Series& series : data.series) {
    for (const Row& row : series.rows) {
      if (std::any_of(row.motions.begin(), row.motions.end(),
                      [kind](const Motion& motion) { return motion.kind == kind; })) {
        return true;
      }
    }
  }
  return false;
}

Frame frame_of(const FrequencyData& data, Size size, double legend) {
  Range loads;
  Range omegas(0, 0);
  for (const Series& series : data.series) {
    for (const Row& row : series.rows) {
      for (const Motion& motion : row.motions) {
        loads.include(row.load_factor);
        omegas.include(motion.omega);
      }
    }
  }
  const Range across = widened(loads);
  const Range up = widened(omegas);
  Frame frame;
  frame.x_label = "load factor";
  frame.y_label = std::string("circular frequency") +
                  (has_kind(data, MotionKind::diverges) ? ", below 0: diverging" : "");
  frame.y = {up.low, up.high, std::max(60.0, size.height - 44), 14 + legend};
  const double left = room_for_numbers(frame);
  frame.x = {across.low, across.high, left, std::max(left + 28, size.width - 14)};
  return frame;
}

/// Draws the lines of one motion from row to row: dashed where both ends flutter, with a gap at rows without
/// frequencies.
void draw_motion(const Series& series, std::size_t number, const Frame& frame, Occupancy& taken,
                 std::vector<Shape>& shapes) {
  constexpr double kUnseen = 0.08;  // pixels
  const std::string looks = series.branch == 0 ? "path " : "path branch ";
  std::vector<Pixel> run;
  bool flutters = false;
  const auto finish = [&] {
    if (run.size() > 1) {
      const std::vector<Pixel> points = thinned_points(run, kUnseen);
      taken.add_line(points, 7);
      shapes.push_back(path(looks + (flutters ? "unstable" : "stable"), points));
    }
    run.clear();
  };
  const Motion* before = nullptr;
  for (const Row& row : series.rows) {
    WorkLimit::poll();
    if (number >= row.motions.size()) {
      finish();
      before = nullptr;
      continue;
    }
    const Motion& motion = row.motions[number];
    const bool both =
        before != nullptr && before->kind == MotionKind::flutters && motion.kind == MotionKind::flutters;
    if (run.size() > 1 && both != flutters) {
      const Pixel last = run.back();
      finish();
      run.push_back(last);
    }
    flutters = both;
    run.push_back(place(frame, row.load_factor, motion.omega));
    before = &motion;
  }
  finish();
}

void draw_series(const FrequencyData& data, const Frame& frame, Occupancy& taken,
                 std::vector<Shape>& shapes) {
  for (const Series& series : data.series) {
    std::size_t count = 0;
    for (const Row& row : series.rows) {
      count = std::max(count, row.motions.size());
    }
    for (std::size_t number = 0; number < count; ++number) {
      draw_motion(series, number, frame, taken, shapes);
    }
  }
  std::vector<Shape> dots;
  for (const Series& series : data.series) {
    for (const Row& row : series.rows) {
      for (std::size_t i = 0; data.few_rows && i < row.motions.size(); ++i) {
        dots.push_back(circle("row", place(frame, row.load_factor, row.motions[i].omega), 3.5));
      }
    }
  }
  shapes.push_back(group("rows", std::move(dots)));
}

/// A critical point with its place in chart values.
struct PlacedPoint {
  CriticalPoint point;
  Point at;
};

std::vector<LegendEntry> legend_of(const FrequencyData& data, const std::vector<PlacedPoint>& placed) {
  std::vector<LegendEntry> entries;
  if (has_kind(data, MotionKind::flutters)) {
    entries.push_back({"pair that flutters", "path unstable"});
  }
  if (std::any_of(data.series.begin(), data.series.end(),
                  [](const Series& one) { return one.branch != 0 && has_motions(one); })) {
    entries.push_back({"branch", "path branch stable"});
  }
  std::set<Mark> marks;
  for (const PlacedPoint& one : placed) {
    marks.insert(one.point.mark);
  }
  for (LegendEntry& mark : mark_entries(marks)) {
    entries.push_back(std::move(mark));
  }
  return entries;
}

/// Returns the range of the lowest frequency and the marked critical points, as sentences.
std::string description_of(const FrequencyData& data, const std::vector<PlacedPoint>& placed) {
  std::size_t rows = 0;
  for (const Series& series : data.series) {
    for (const Row& row : series.rows) {
      rows += row.motions.empty() ? 0 : 1;
    }
  }
  std::vector<CriticalPoint> points;
  points.reserve(placed.size());
  for (const PlacedPoint& one : placed) {
    points.push_back(one.point);
  }
  return "Natural circular frequencies at " + std::to_string(rows) + (rows == 1 ? " state." : " states.") +
         (has_kind(data, MotionKind::diverges) ? " A motion below zero grows without vibrating." : "") +
         points_text(points);
}

}  // namespace

Figure frequencies_figure(const ResultInput& input, Size size) {
  const FrequencyData data = read_frequencies(input.result);
  std::vector<PlacedPoint> placed;
  for (const CriticalPoint& point : data.points) {
    if (const std::optional<Point> at = place_of(data, point)) {
      placed.push_back({point, *at});
    }
  }
  const std::vector<LegendEntry> legend = legend_of(data, placed);
  const Frame frame = frame_of(data, size, legend_height(legend, size.width));
  Occupancy taken(size);
  keep_margins(frame, size, taken);
  Figure figure;
  figure.title = "Circular frequency over the load factor";
  figure.description = description_of(data, placed);
  figure.shapes.push_back(frame_shape(frame, size));
  draw_series(data, frame, taken, figure.shapes);
  std::vector<PlacedMark> marks;
  marks.reserve(placed.size());
  for (const PlacedPoint& one : placed) {
    marks.push_back(placed_mark(one.point, place(frame, one.at.x, one.at.y)));
  }
  draw_marks(marks, taken, figure.shapes);
  figure.shapes.push_back(legend_shape(legend, size.width));
  return figure;
}

}  // namespace snapthrough::api::plot
