#include <algorithm>
#include <cmath>

#include "api/plot/axes.h"
#include "api/plot/figures.h"
#include "api/plot/labels.h"
#include "api/plot/law.h"
#include "api/plot/marks.h"
#include "api/plot/numbers.h"
#include "api/plot/result.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr std::size_t kMostDots = 40;  // more points of a table are crowded
constexpr double kCaption = 18;        // pixels; height of the caption above the legend
constexpr const char* kNoBreak = "\u00a0";

/// Displacement w and reaction p.
using LawPoint = Point;

/// A curve in the chart's values.
struct DrawnCurve {
  std::string name;
  std::vector<LawPoint> points;
  std::vector<LawPoint> dots;  ///< points of a table
};

/// Returns the senses of w in which the support reacts: 1 into the medium, -1 away from it.
std::vector<double> senses_of(const SupportLaw& law) {
  if (law.reaction == "bilateral") {
    return {-1, 1};
  }
  return {law.reaction == "tension_only" ? -1.0 : 1.0};
}

/// Returns the displacements beyond the gap at which a curve is computed: close where it bends.
std::vector<double> samples_of(const LawCurve& curve, double reach) {
  std::vector<double> all = curve.ends;
  for (int i = 0; i <= LawDrawing::pieces; ++i) {
    const double share = static_cast<double>(i) / LawDrawing::pieces;
    all.push_back(share * reach);
    all.push_back(share * share * curve.reach);
  }
  std::erase_if(all, [&](double w) { return w > reach; });
  std::sort(all.begin(), all.end());
  return all;
}

/// Returns the points of one side of a curve in the order of w, for the sense 1 or -1.
std::vector<LawPoint> in_sense(double sense, std::vector<LawPoint> points) {
  if (sense < 0) {
    for (LawPoint& point : points) {
      point = {-point.x, -point.y};
    }
    std::reverse(points.begin(), points.end());
  }
  return points;
}

DrawnCurve drawn_curve(const SupportLaw& law, const LawCurve& curve, double reach) {
  const std::vector<double> senses = senses_of(law);
  const auto point_at = [&](double w) {
    WorkLimit::poll();
    return LawPoint{law.gap + w, curve.law.force_at(w)};
  };
  std::vector<LawPoint> half;
  if (senses.size() == 1) {
    half.push_back({-LawDrawing::free * (law.gap + reach), 0});
  }
  for (const double w : samples_of(curve, reach)) {
    half.push_back(point_at(w));
  }
  std::vector<LawPoint> ends;
  if (law.type == "table" && curve.ends.size() * senses.size() <= kMostDots) {
    for (const double w : curve.ends) {
      ends.push_back(point_at(w));
    }
  }
  DrawnCurve drawn{format_number(curve.fraction, 3) + kNoBreak + "L", {}, {}};
  for (const double sense : senses) {
    for (const LawPoint& point : in_sense(sense, half)) {
      drawn.points.push_back(point);
    }
    for (const LawPoint& point : in_sense(sense, ends)) {
      drawn.dots.push_back(point);
    }
  }
  return drawn;
}

std::vector<DrawnCurve> drawn_curves(const SupportLaw& law) {
  double reach = 0;
  for (const LawCurve& curve : law.curves) {
    reach = std::max(reach, LawDrawing::room * curve.reach);
  }
  std::vector<DrawnCurve> drawn;
  drawn.reserve(law.curves.size());
  for (const LawCurve& curve : law.curves) {
    drawn.push_back(drawn_curve(law, curve, reach));
  }
  return drawn;
}

/// Returns the unit of p: a foundation's is a force per length, or against rotation a moment per length,
/// which is a force; a rotational spring's is a moment.
std::string reaction_unit(const SupportLaw& law, const Units& units) {
  if (law.turns && law.is_spring) {
    return unit_of(units, Quantity::moment);
  }
  return unit_of(units, law.turns || law.is_spring ? Quantity::force : Quantity::line_load);
}

std::string law_name(const SupportLaw& law) {
  std::string sense = law.reaction;
  std::replace(sense.begin(), sense.end(), '_', ' ');
  return "Law of " + law.id + ": " + law.type + ", " + sense;
}

std::vector<LegendEntry> legend_of(const std::vector<DrawnCurve>& curves) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; curves.size() > 1 && i < curves.size(); ++i) {
    entries.push_back({curves[i].name, "series-line", "series series-" + std::to_string(i)});
  }
  return entries;
}

Frame frame_of(const SupportLaw& law, const Units& units, const std::vector<DrawnCurve>& curves, Size size,
               double top) {
  Range w;
  Range p;
  for (const DrawnCurve& curve : curves) {
    for (const LawPoint& point : curve.points) {
      w.include(point.x);
      p.include(point.y);
    }
  }
  const Range up = widened(p);
  Frame frame;
  frame.x_label = name_with_unit(
      std::string(law.turns ? "rotation w" : "displacement w") + (law.gap_varies ? " beyond the gap" : ""),
      unit_of(units, law.turns ? Quantity::rotation : Quantity::length));
  frame.y_label = name_with_unit(law.turns ? "moment p" : "reaction p", reaction_unit(law, units));
  frame.y = {up.low, up.high, std::max(60.0, size.height - 44), top};
  const double left = std::max(66.0, room_for_numbers(frame));
  frame.x = {w.low, w.high, left, std::max(left + 28, size.width - 14)};
  return frame;
}

Shape curve_shape(const DrawnCurve& curve, std::size_t number, const Frame& frame) {
  std::vector<Pixel> pixels;
  pixels.reserve(curve.points.size());
  for (const LawPoint& point : curve.points) {
    pixels.push_back(place(frame, point.x, point.y));
  }
  std::vector<Shape> shapes{path("series-line", thinned_points(pixels, LawDrawing::tolerance))};
  for (const LawPoint& dot : curve.dots) {
    shapes.push_back(circle("series-dot", place(frame, dot.x, dot.y), 2.4));
  }
  return group("series series-" + std::to_string(number), std::move(shapes));
}

/// Returns the largest reaction that is drawn, the capacity at each drawn place, and the gap, as sentences.
std::string description_of(const SupportLaw& law, const Units& units, const std::vector<DrawnCurve>& curves) {
  const std::string unit = reaction_unit(law, units);
  double most = 0;
  std::string text;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const LawPoint& point : curves[i].points) {
      most = std::max(most, std::abs(point.y));
    }
    const Law& curve = law.curves[i].law;
    text += " Capacity " + (curve.stiffness > 0 ? with_unit(curve.capacity, unit) : "0") +
            (curves.size() > 1 ? " at " + curves[i].name : "") + ".";
  }
  if (law.gap > 0) {
    text +=
        " Gap " + with_unit(law.gap, unit_of(units, law.turns ? Quantity::rotation : Quantity::length)) + ".";
  }
  return "Drawn up to " + with_unit(most, unit) + ", positive into the medium." + text;
}

}  // namespace

Figure law_figure(const Field& model, const PlotRequest& request, Size size) {
  const SupportLaw law = read_support_law(model, request.law);
  const Units units = read_model_units(model);
  const std::vector<DrawnCurve> curves = drawn_curves(law);
  const std::vector<LegendEntry> legend = legend_of(curves);
  const Frame frame = frame_of(law, units, curves, size, 10 + kCaption + legend_height(legend, size.width));
  Figure figure;
  figure.title = law_name(law);
  figure.description = frame.y_label + " over " + frame.x_label + ". " + description_of(law, units, curves);
  figure.shapes.push_back(frame_shape(frame, size));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    figure.shapes.push_back(curve_shape(curves[i], i, frame));
  }
  figure.shapes.push_back(label("caption", {frame.x.start, 12}, Anchor::start,
                                fitted(law_name(law), size.width - frame.x.start, 12, true)));
  figure.shapes.push_back(legend_shape(legend, size.width, kCaption));
  return figure;
}

}  // namespace snapthrough::api::plot
