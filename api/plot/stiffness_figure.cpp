#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "api/plot/axes.h"
#include "api/plot/chart_marks.h"
#include "api/plot/figures.h"
#include "api/plot/labels.h"
#include "api/plot/numbers.h"
#include "api/plot/plot_error.h"
#include "api/plot/result.h"
#include "solver/numeric/bracket.h"
#include "solver/numeric/cubic.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

/// Stiffness ratio at a point of the primary path.
struct Sample {
  double load_factor = 0;
  double ratio = 0;  ///< kNone: not known
  double arc = 0;    ///< arc length of the path
};

/// The primary path with its ratios, up to the first loss of stability.
struct StiffnessData {
  std::vector<Sample> samples;
  std::vector<CriticalPoint> points;  ///< critical points on the curve
  std::optional<Softest> softest;
};

/// Throws the reason why a result has no stiffness ratios.
[[noreturn]] void fail_without_path(const Field& result) {
  if (const std::optional<Field> failure = result.find("failure")) {
    throw PlotError("/failure",
                    "the analysis failed before it had a path: " + text_or(*failure, "detail", ""));
  }
  throw PlotError("/branches",
                  "the result has no path; an analysis of type path has the stiffness ratio along its path");
}

/// Returns the first critical point of the primary path at which its stiffness is zero. A broken bifurcation
/// lies beside the path, and flutter begins at a stiffness that is not zero.
const CriticalPoint* first_loss(const std::vector<CriticalPoint>& points) {
  const CriticalPoint* first = nullptr;
  for (const CriticalPoint& point : points) {
    const bool is_loss = point.mark != Mark::broken_bifurcation && point.mark != Mark::flutter;
    if (is_loss && (first == nullptr || point.arc_length < first->arc_length)) {
      first = &point;
    }
  }
  return first;
}

/// Returns the arc length at which a branch first comes to a load factor; nullopt where it does not.
std::optional<double> arc_at_load(const Branch& branch, double load) {
  for (std::size_t i = 1; i < branch.load_factor.size(); ++i) {
    WorkLimit::poll();
    const double before = branch.load_factor[i - 1];
    const double after = branch.load_factor[i];
    if ((before - load) * (after - load) > 0) {
      continue;
    }
    const double length = branch.arc_length[i] - branch.arc_length[i - 1];
    const auto load_at = [&](double fraction) {
      if (!branch.rates || !(length > 0)) {
        return before + fraction * (after - before);
      }
      const CubicWeights h(fraction * length, length);
      const std::vector<double>& rates = branch.rates->load_factor;
      return h.a * before + h.da * rates[i - 1] + h.b * after + h.db * rates[i];
    };
    const double share = before == load ? 0 : bisect(0.0, 1.0, 1e-9, [&](double fraction) {
      return (load_at(fraction) < load) != (before < load);
    });
    return branch.arc_length[i - 1] + share * length;
  }
  return std::nullopt;
}

/// Returns the ratio on the line through the samples at an arc length; kNone beyond its ends or in a gap.
double ratio_at(const std::vector<Sample>& samples, double arc) {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    WorkLimit::poll();
    const Sample& before = samples[i - 1];
    const Sample& after = samples[i];
    if (!(before.arc <= arc && arc <= after.arc)) {
      continue;
    }
    if (arc == before.arc || arc == after.arc) {
      return arc == before.arc ? before.ratio : after.ratio;
    }
    const double share = (arc - before.arc) / (after.arc - before.arc);
    return before.ratio + share * (after.ratio - before.ratio);
  }
  return kNone;
}

/// Reads the ratios of the rows before the first loss of stability. A branch that tells which of its rows are
/// computed has none in the others, and the line goes on past every row without a ratio.
std::vector<Sample> read_rows(const Field& field, const Branch& branch, const CriticalPoint* loss) {
  const Field list = field.at("stiffness_ratio");
  const std::vector<double> ratios = list.numbers_or_none();
  if (ratios.size() != branch.load_factor.size()) {
    list.fail("must have as many values as load_factor");
  }
  if (std::none_of(ratios.begin(), ratios.end(), [](double ratio) { return std::isfinite(ratio); })) {
    list.fail("no row of the path has a stiffness ratio");
  }
  const bool tells_computed = field.find("computed").has_value();
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const bool is_before = loss == nullptr || branch.arc_length[i] < loss->arc_length;
    if (is_before && !(tells_computed && std::isnan(ratios[i]))) {
      samples.push_back({branch.load_factor[i], ratios[i], branch.arc_length[i]});
    }
  }
  return samples;
}

StiffnessData read_stiffness(const Field& result) {
  const std::optional<Field> branches = result.find("branches");
  if (!branches || branches->size() == 0) {
    fail_without_path(result);
  }
  const Branch branch = read_branches(result).front();
  StiffnessData data;
  data.points = read_critical_points(result);
  std::erase_if(data.points, [](const CriticalPoint& point) { return point.branch != 0; });
  const CriticalPoint* const loss = first_loss(data.points);
  data.samples = read_rows(branches->item(0), branch, loss);
  data.softest = read_softest(result);
  const std::optional<double> arc =
      data.softest ? arc_at_load(branch, data.softest->load_factor) : std::nullopt;
  if (arc) {
    data.samples.push_back({data.softest->load_factor, data.softest->ratio, *arc});
  } else {
    data.softest.reset();
  }
  if (loss != nullptr) {
    data.samples.push_back({loss->load_factor, 0, loss->arc_length});
  }
  std::stable_sort(data.samples.begin(), data.samples.end(),
                   [](const Sample& a, const Sample& b) { return a.arc < b.arc; });
  const double end = loss != nullptr ? loss->arc_length : std::numeric_limits<double>::infinity();
  std::erase_if(data.points, [&](const CriticalPoint& point) {
    return point.arc_length > end || point.mark == Mark::broken_bifurcation ||
           std::isnan(ratio_at(data.samples, point.arc_length));
  });
  return data;
}

/// Returns a range of load factors with room for the labels of the critical points at its end: the line comes
/// from the left, and is steep at a limit point.
/// @param width of the plot in pixels
Range with_room(const StiffnessData& data, Range range, double width) {
  constexpr double kDistance = 24;  // pixels between the mark and the figure's end, besides the label
  constexpr double kMost = 0.3;     // share of the plot
  for (const CriticalPoint& point : data.points) {
    double label = kDistance;
    for (const Run& run : placed_mark(point, {}).runs) {
      label += text_width(run.text + " ", 12, run.bold);
    }
    const double share = std::min(kMost, label / width);
    range.high = std::max(range.high, range.low + (point.load_factor - range.low) / (1 - share));
  }
  return range;
}

Frame frame_of(const StiffnessData& data, Size size, double legend) {
  Range loads;
  Range ratios(0, 1);  // without load, and where stability is lost
  for (const Sample& sample : data.samples) {
    if (std::isfinite(sample.ratio)) {
      loads.include(sample.load_factor);
      ratios.include(sample.ratio);
    }
  }
  const bool is_usual = ratios.low == 0 && ratios.high <= 1.02;  // the accuracy of ratios is better
  const Range up = is_usual ? Range(0, ratios.high) : widened(ratios);
  Frame frame;
  frame.x_label = "load factor";
  frame.y_label = "stiffness ratio";
  frame.y = {up.low, up.high, std::max(60.0, size.height - 44), 14 + legend};
  if (is_usual && frame.y.start - frame.y.end > 180) {
    frame.y_values = {0, 0.1, 0.5, 1};  // below a tenth a structure is nearly unstable
  }
  const double left = room_for_numbers(frame);
  const double right = std::max(left + 28, size.width - 14);
  const Range across = with_room(data, widened(loads), right - left);
  frame.x = {across.low, across.high, left, right};
  return frame;
}

/// Draws the line, interrupted where the ratio is not known.
void draw_line(const StiffnessData& data, const Frame& frame, Occupancy& taken, std::vector<Shape>& shapes) {
  constexpr double kUnseen = 0.08;  // pixels
  std::vector<Pixel> part;
  std::string text;
  const auto finish = [&] {
    const std::vector<Pixel> points = thinned_points(part, kUnseen);
    taken.add_line(points, 7);
    text += path_data(points);
    part.clear();
  };
  for (const Sample& sample : data.samples) {
    if (std::isfinite(sample.ratio)) {
      part.push_back(place(frame, sample.load_factor, sample.ratio));
    } else {
      finish();
    }
  }
  finish();
  shapes.push_back(path_of("path stable", text));
}

std::vector<PlacedMark> marks_of(const StiffnessData& data, const Frame& frame) {
  std::vector<PlacedMark> marks;
  marks.reserve(data.points.size() + 1);
  for (const CriticalPoint& point : data.points) {
    marks.push_back(
        placed_mark(point, place(frame, point.load_factor, ratio_at(data.samples, point.arc_length))));
  }
  if (data.softest) {
    marks.push_back(placed_mark(*data.softest, place(frame, data.softest->load_factor, data.softest->ratio)));
  }
  return marks;
}

std::vector<LegendEntry> legend_of(const StiffnessData& data) {
  std::set<Mark> marks;
  for (const CriticalPoint& point : data.points) {
    marks.insert(point.mark);
  }
  if (data.softest) {
    marks.insert(Mark::softest);
  }
  return mark_entries(marks);
}

}  // namespace

Figure stiffness_figure(const ResultInput& input, Size size) {
  const StiffnessData data = read_stiffness(input.result);
  const std::vector<LegendEntry> legend = legend_of(data);
  const Frame frame = frame_of(data, size, legend_height(legend, size.width));
  Occupancy taken(size);
  keep_margins(frame, size, taken);
  Figure figure;
  figure.title = "Stiffness ratio over the load factor";
  figure.description =
      "Least stiffness along the primary path over that of the unloaded structure: 1 without load, 0 where "
      "stability is lost." +
      points_text(data.points);
  if (data.softest) {
    figure.description += " Softest point at load factor " + format_number(data.softest->load_factor, 6) +
                          ", ratio " + format_number(data.softest->ratio, 3) + ".";
  }
  figure.shapes.push_back(frame_shape(frame, size));
  draw_line(data, frame, taken, figure.shapes);
  draw_marks(marks_of(data, frame), taken, figure.shapes);
  figure.shapes.push_back(legend_shape(legend, size.width));
  return figure;
}

}  // namespace snapthrough::api::plot
