#include "api/plot/labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kCell = 4;
constexpr double kSize = 12;
constexpr double kDiagonal = 0.75;
constexpr int kEighths[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

bool is_one_of(char32_t point, std::u32string_view all) {
  return all.find(point) != std::u32string_view::npos;
}

/// Returns the estimated width of a character relative to the font size.
double width_of(char32_t point) {
  if (is_one_of(point, U"ilI.,:;'|!\u202f\u00a0 ()-")) {
    return 0.34;
  }
  if (is_one_of(point, U"mwMW@%\u2013\u2212=\u00d7")) {
    return 0.9;
  }
  if (point >= 'A' && point <= 'Z') {
    return 0.7;
  }
  return point >= 0x1100 && point < 0xfb00 && !(point >= 0x2000 && point < 0x2e80) ? 1.05 : 0.585;
}

struct Candidate {
  Box box;
  Pixel text;
  Anchor anchor = Anchor::start;
  double cost = std::numeric_limits<double>::infinity();
  bool far = false;
};

Candidate candidate(const LabelRequest& request, int eighth, int ring, double width, const Occupancy& taken) {
  const double dx = kEighths[eighth][0];
  const double dy = kEighths[eighth][1];
  const double reach = request.distance + ring * (kSize + 2);
  const double scale = dx != 0 && dy != 0 ? kDiagonal : 1;
  const double x = request.at.x + dx * reach * scale;
  const double middle = request.at.y + dy * (reach * scale + kSize * 0.5);
  const double left = dx > 0 ? x : dx < 0 ? x - width : x - width / 2;
  Candidate result;
  result.box = {left - 2, middle - kSize * 0.62, left + width + 2, middle + kSize * 0.62};
  result.text = {x, middle + kSize * 0.36};
  result.anchor = dx > 0 ? Anchor::start : dx < 0 ? Anchor::end : Anchor::middle;
  result.far = ring > 0;
  const int turn = std::abs(((eighth - request.prefer + 12) % 8) - 4);  // turn in steps of 45 degrees
  result.cost = taken.cost(result.box) + turn * 1.5 + ring * 22;
  return result;
}

/// Returns a line from near the anchor to the nearest point of the label's box.
Shape leader_shape(Pixel at, const Box& box) {
  const Pixel end{std::clamp(at.x, box.left, box.right), std::clamp(at.y, box.top, box.bottom)};
  const double length = std::hypot(end.x - at.x, end.y - at.y);
  const double share = length > 0 ? std::min(1.0, 7 / length) : 1;
  return line("leader", {at.x + share * (end.x - at.x), at.y + share * (end.y - at.y)}, end);
}

Shape run_shape(const Run& run) {
  std::string looks = run.looks;
  if (run.bold) {
    looks += looks.empty() ? "strong" : " strong";
  }
  return looks.empty() ? text_node(run.text) : element("tspan", {{"class", looks}}, {text_node(run.text)});
}

}  // namespace

double text_width(std::string_view text, double size, bool bold) {
  double em = 0;
  for (const char32_t point : code_points(text)) {
    em += width_of(point);
  }
  return em * size * (bold ? 1.15 : 1);
}

std::string fitted(std::string_view text, double width, double size, bool bold) {
  if (text_width(text, size, bold) <= width) {
    return std::string(text);
  }
  const double room = width / (size * (bold ? 1.15 : 1)) - 0.9;
  std::string kept;
  double em = 0;
  for (const char32_t point : code_points(text)) {
    em += width_of(point);
    if (em > room) {
      break;
    }
    append_utf8(kept, point);
  }
  return kept + "\u2026";
}

Occupancy::Occupancy(Size size)
    : size_(size),
      columns_(static_cast<std::size_t>(std::ceil(size.width / kCell))),
      rows_(static_cast<std::size_t>(std::ceil(size.height / kCell))),
      weight_(columns_ * rows_) {}

void Occupancy::add(double column, double row, int weight) {
  if (!(column >= 0 && row >= 0 && column < static_cast<double>(columns_) &&
        row < static_cast<double>(rows_))) {
    return;
  }
  std::uint8_t& cell = weight_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
  cell = static_cast<std::uint8_t>(std::min(255, std::max<int>(weight, cell)));
}

void Occupancy::add_box(const Box& box, int weight) {
  const double last_row = std::min(std::floor(box.bottom / kCell), static_cast<double>(rows_));
  const double last_column = std::min(std::floor(box.right / kCell), static_cast<double>(columns_));
  for (double row = std::max(0.0, std::floor(box.top / kCell)); row <= last_row; ++row) {
    for (double column = std::max(0.0, std::floor(box.left / kCell)); column <= last_column; ++column) {
      add(column, row, weight);
    }
  }
}

void Occupancy::add_line(std::span<const Pixel> points, int weight) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    WorkLimit::poll();
    const Pixel& a = points[i - 1];
    const Pixel& b = points[i];
    const double steps = std::min(2000.0, std::ceil(std::hypot(b.x - a.x, b.y - a.y) / kCell));
    for (double k = 0; k <= steps; ++k) {
      const double t = steps == 0 ? 0 : k / steps;
      add(std::floor((a.x + t * (b.x - a.x)) / kCell), std::floor((a.y + t * (b.y - a.y)) / kCell), weight);
    }
  }
}

double Occupancy::cost(const Box& box) const {
  constexpr double kImpossible = std::numeric_limits<double>::infinity();
  if (!(box.left >= 0 && box.top >= 0 && box.right <= size_.width && box.bottom <= size_.height)) {
    return kImpossible;
  }
  double sum = 0;
  for (auto row = static_cast<std::size_t>(box.top / kCell);
       row <= static_cast<std::size_t>(box.bottom / kCell); ++row) {
    for (auto column = static_cast<std::size_t>(box.left / kCell);
         column <= static_cast<std::size_t>(box.right / kCell); ++column) {
      const int weight = row < rows_ && column < columns_ ? weight_[row * columns_ + column] : 0;
      if (weight >= kLabelWeight) {
        return kImpossible;
      }
      sum += weight;
    }
  }
  return sum;
}

std::optional<Shape> place_label(const LabelRequest& request, Occupancy& taken) {
  WorkLimit::poll();
  double width = 0;
  for (const Run& run : request.runs) {
    width += text_width(run.text, kSize, run.bold) + (width > 0 ? text_width(" ") : 0);
  }
  Candidate best;
  for (int ring = 0; ring < request.rings; ++ring) {
    for (int eighth = 0; eighth < 8; ++eighth) {
      const Candidate next = candidate(request, eighth, ring, width, taken);
      if (next.cost < best.cost) {
        best = next;
      }
    }
  }
  if (!(best.cost <= request.tolerance)) {
    return std::nullopt;
  }
  taken.add_box(best.box);
  std::vector<Shape> runs;
  for (const Run& run : request.runs) {
    if (!runs.empty()) {
      runs.push_back(text_node(" "));
    }
    runs.push_back(run_shape(run));
  }
  Shape text = label_of(request.looks, best.text, best.anchor, std::move(runs));
  return request.leader && best.far ? group("led", {leader_shape(request.at, best.box), std::move(text)})
                                    : std::move(text);
}

}  // namespace snapthrough::api::plot
