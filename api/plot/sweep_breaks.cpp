#include "api/plot/sweep_breaks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "api/plot/labels.h"

namespace snapthrough::api::plot {
namespace {

constexpr std::size_t kMostNames = 6;
constexpr double kRing = 3.2;         // pixels
constexpr double kSamePlace = 1.5;    // pixels between two ends that get one ring
constexpr double kLongestName = 340;  // pixels

/// Returns the breaks in the order in which they get names: the first one of each change, then the others.
std::vector<const SweepBreak*> by_news(const std::vector<SweepBreak>& breaks) {
  std::set<std::string> known;
  std::vector<const SweepBreak*> fresh;
  std::vector<const SweepBreak*> again;
  for (const SweepBreak& one : breaks) {
    if (!one.change.empty()) {
      (known.insert(one.change).second ? fresh : again).push_back(&one);
    }
  }
  fresh.insert(fresh.end(), again.begin(), again.end());
  return fresh;
}

/// Returns the ends that are drawn.
std::vector<Pixel> ends_of(const SweepBreak& one) {
  std::vector<Pixel> ends;
  for (const Pixel& end : {one.before, one.after}) {
    const bool is_new = ends.empty() || std::hypot(end.x - ends[0].x, end.y - ends[0].y) >= kSamePlace;
    if (std::isfinite(end.y) && is_new) {
      ends.push_back(end);
    }
  }
  return ends;
}

}  // namespace

bool is_break(const Table& table, std::size_t before, std::size_t after) {
  const bool both_failed = !table.errors[before].empty() && !table.errors[after].empty();
  return !table.pieces.empty() && !both_failed && table.pieces[before] != table.pieces[after];
}

std::string change_at(const Table& table, std::size_t before, std::size_t after) {
  const std::size_t later = std::max(before, after);  // a row tells what differs from the row before it
  return table.errors[later].empty() ? table.changes[later] : "no value, failure: " + table.errors[later];
}

std::string breaks_text(const std::vector<SweepBreak>& breaks) {
  if (breaks.empty()) {
    return "";
  }
  std::string text = breaks.size() == 1 ? " One break:" : " " + std::to_string(breaks.size()) + " breaks:";
  std::set<std::string> known;
  for (const SweepBreak& one : breaks) {
    if (!one.change.empty() && known.size() < kMostNames && known.insert(one.change).second) {
      text += (known.size() == 1 ? " " : "; ") + one.change;
    }
  }
  return text + ".";
}

Shape breaks_shape(const std::vector<SweepBreak>& breaks, const std::vector<std::vector<Pixel>>& curves,
                   Size size, const Box& inside) {
  std::vector<Shape> shapes;
  Occupancy taken(size);
  taken.add_box({0, 0, size.width, inside.top});
  taken.add_box({0, inside.bottom, size.width, size.height});
  taken.add_box({0, 0, inside.left, size.height});
  taken.add_box({inside.right, 0, size.width, size.height});
  for (const std::vector<Pixel>& curve : curves) {
    taken.add_line(curve);
  }
  for (const SweepBreak& one : breaks) {
    for (const Pixel& end : ends_of(one)) {
      shapes.push_back(circle("break-mark", end, kRing));
      taken.add_box({end.x - kRing, end.y - kRing, end.x + kRing, end.y + kRing});
    }
  }
  std::size_t names = 0;
  for (const SweepBreak* one : by_news(breaks)) {
    const std::vector<Pixel> ends = ends_of(*one);
    if (names == kMostNames || ends.empty()) {
      continue;
    }
    LabelRequest request{
        .at = ends.back(), .runs = {{fitted(one->change, kLongestName), ""}}, .looks = "break-text"};
    request.leader = true;
    if (std::optional<Shape> name = place_label(request, taken)) {
      shapes.push_back(*std::move(name));
      ++names;
    }
  }
  return group("breaks", std::move(shapes));
}

}  // namespace snapthrough::api::plot
