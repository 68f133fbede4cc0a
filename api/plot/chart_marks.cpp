#include "api/plot/chart_marks.h"

#include <optional>
#include <utility>

#include "api/plot/numbers.h"

namespace snapthrough::api::plot {

PlacedMark placed_mark(const CriticalPoint& point, Pixel at) {
  return {point.mark,
          at,
          {{format_number(point.load_factor, 5), "", true},
           {std::string(mark_text(point.mark)) + (point.confirmed ? "" : ", not confirmed"), "muted"}}};
}

PlacedMark placed_mark(const Softest& softest, Pixel at) {
  return {Mark::softest,
          at,
          {{format_number(softest.load_factor, 5), "", true},
           {"softest, ratio " + format_number(softest.ratio, 3), "muted"}}};
}

PlacedMark placed_mark(const FirstYield& yield, Pixel at) {
  return {Mark::first_yield,
          at,
          {{format_number(yield.load_factor, 5), "", true}, {mark_text(Mark::first_yield), "muted"}}};
}

void draw_marks(const std::vector<PlacedMark>& marks, Occupancy& taken, std::vector<Shape>& shapes) {
  std::vector<Shape> drawn;
  for (const PlacedMark& mark : marks) {
    const auto [x, y] = mark.at;
    taken.add_box({x - 11, y - 11, x + 11, y + 11}, 14);
    taken.add_box({x - 4, y - 5, x + 4, y + 4}, 60);
    drawn.push_back(mark_shape(mark.mark, mark.at));
  }
  std::vector<Shape> labels;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    LabelRequest wanted{marks[i].at, marks[i].runs, "mark-label", 14};
    wanted.leader = true;
    wanted.tolerance = i == 0 ? 400 : 110;
    wanted.prefer = marks[i].mark == Mark::limit_min || marks[i].mark == Mark::softest ? 1 : 7;
    if (std::optional<Shape> text = place_label(wanted, taken)) {
      labels.push_back(std::move(*text));
    }
  }
  shapes.push_back(group("marks", std::move(drawn)));
  shapes.push_back(group("mark-labels", std::move(labels)));
}

void keep_margins(const Frame& frame, Size size, Occupancy& taken) {
  taken.add_box({0, 0, size.width, frame.y.end - 4});
  taken.add_box({0, 0, frame.x.start - 4, size.height});
  taken.add_box({0, frame.y.start + 4, size.width, size.height});
}

std::string points_text(const std::vector<CriticalPoint>& points) {
  constexpr std::size_t kMost = 50;
  std::string text;
  for (std::size_t i = 0; i < points.size() && i < kMost; ++i) {
    text += std::string(" ") + mark_text(points[i].mark) + " at load factor " +
            format_number(points[i].load_factor, 6) + (points[i].confirmed ? "." : ", not confirmed.");
  }
  if (points.size() > kMost) {
    text += " And " + std::to_string(points.size() - kMost) + " more critical points.";
  }
  return text;
}

}  // namespace snapthrough::api::plot
