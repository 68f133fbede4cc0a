/// Places at which segments cross without an end there.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "api/convert/dxf_joints.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::convert {

namespace {

/// Number of crossings at which the count ends, which bounds the time of hatched drawings.
constexpr std::size_t kMostCrossings = 10'000;

struct Circle {
  PlanePoint centre{};
  double radius = 0.0;
};

Circle circle_of(const Shape& arc) {
  const double r = 1.0 / arc.curvature;
  return {{arc.start[0] - r * arc.tangent[1], arc.start[1] + r * arc.tangent[0]}, std::abs(r)};
}

/// Places that two curves have in common.
struct Common {
  std::array<PlanePoint, 2> points{};
  std::size_t count = 0;
  bool touches = false;  ///< the curves overlap by less than the tolerance
};

/// Returns the points of a circle on a straight line of a direction whose distance from the centre is signed
/// to the left; one point where they touch.
Common on_line(const Circle& circle, double distance, const PlanePoint& direction, bool touches) {
  const double half =
      touches ? 0.0 : std::sqrt(std::max(0.0, (circle.radius - distance) * (circle.radius + distance)));
  Common common;
  common.touches = touches;
  for (const double side : {-half, half}) {
    common.points[common.count++] = {circle.centre[0] - distance * direction[1] + side * direction[0],
                                     circle.centre[1] + distance * direction[0] + side * direction[1]};
    if (touches) {
      break;
    }
  }
  return common;
}

Common lines(const Shape& one, const Shape& other) {
  const double cross = one.tangent[0] * other.tangent[1] - one.tangent[1] * other.tangent[0];
  if (cross == 0.0) {
    return {};
  }
  const double dx = other.start[0] - one.start[0];
  const double dy = other.start[1] - one.start[1];
  const double s = (dx * other.tangent[1] - dy * other.tangent[0]) / cross;
  return {{PlanePoint{one.start[0] + s * one.tangent[0], one.start[1] + s * one.tangent[1]}}, 1, false};
}

Common line_and_circle(const Shape& line, const Circle& circle, double tolerance) {
  const double dx = line.start[0] - circle.centre[0];
  const double dy = line.start[1] - circle.centre[1];
  const double distance = dy * line.tangent[0] - dx * line.tangent[1];
  const double overlap = circle.radius - std::abs(distance);
  return overlap < -tolerance ? Common() : on_line(circle, distance, line.tangent, overlap <= tolerance);
}

Common circles(const Circle& one, const Circle& other, double tolerance) {
  const double dx = other.centre[0] - one.centre[0];
  const double dy = other.centre[1] - one.centre[1];
  const double d = std::hypot(dx, dy);
  const double overlap = std::min(one.radius + other.radius - d, d - std::abs(one.radius - other.radius));
  if (d <= tolerance || overlap < -tolerance) {
    return {};
  }
  const bool touch = overlap <= tolerance;
  const double along = 0.5 * (d + (one.radius - other.radius) * ((one.radius + other.radius) / d));
  // both circles cross on their common chord, a line at the distance `along` from the centre of the first
  // one; its left normal points to the centre of the second one
  return on_line(one, touch ? std::copysign(one.radius, along) : along, {dy / d, -dx / d}, touch);
}

class CrossingSearch {
 public:
  explicit CrossingSearch(const DrawnPieces& drawn);

  void run(std::vector<Warning>& warnings);

 private:
  struct Box {
    PlanePoint low{};
    PlanePoint high{};
  };
  [[nodiscard]] const Shape& shape(int i) const { return shapes_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Box& box(int i) const { return boxes_[static_cast<std::size_t>(i)]; }
  /// Whether a piece departs from its chord by more than the tolerance.
  [[nodiscard]] bool is_arc(int i) const { return std::abs(shape(i).rise) > drawn_.tolerance; }
  [[nodiscard]] Common common_of(int i, int j) const;
  [[nodiscard]] bool has_end(const PlanePoint& point);
  void compare(int i, int j);
  void compare_all();

  const DrawnPieces& drawn_;
  std::vector<Shape> shapes_;
  std::vector<Box> boxes_;
  std::vector<int> found_;
  Places crossings_;
};

CrossingSearch::CrossingSearch(const DrawnPieces& drawn) : drawn_(drawn) {
  for (const Piece& piece : drawn.pieces) {
    shapes_.push_back(shape_of(piece, drawn.nodes));
    const PlanePoint& a = drawn.nodes[piece.start];
    const PlanePoint& b = drawn.nodes[piece.end];
    const double reach = std::abs(shapes_.back().rise) + 0.5 * drawn.tolerance;
    Box box;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
      box.low[axis] = std::min(a[axis], b[axis]) - reach;
      box.high[axis] = std::max(a[axis], b[axis]) + reach;
    }
    boxes_.push_back(box);
  }
}

Common CrossingSearch::common_of(int i, int j) const {
  if (!is_arc(i) && !is_arc(j)) {
    return lines(shape(i), shape(j));
  }
  if (is_arc(i) && is_arc(j)) {
    return circles(circle_of(shape(i)), circle_of(shape(j)), drawn_.tolerance);
  }
  return is_arc(i) ? line_and_circle(shape(j), circle_of(shape(i)), drawn_.tolerance)
                   : line_and_circle(shape(i), circle_of(shape(j)), drawn_.tolerance);
}

bool CrossingSearch::has_end(const PlanePoint& point) {
  found_.clear();
  drawn_.nodes.near(point, point, drawn_.tolerance, found_);
  return !found_.empty();
}

void CrossingSearch::compare(int i, int j) {
  const Piece& one = drawn_.pieces[static_cast<std::size_t>(i)];
  const Piece& other = drawn_.pieces[static_cast<std::size_t>(j)];
  const bool at_start = one.start == other.start || one.start == other.end;
  const bool at_end = one.end == other.start || one.end == other.end;
  if (at_start && at_end) {
    return;  // two lines or circles have no third point in common
  }
  const Common common = common_of(i, j);
  if (common.touches && (at_start || at_end)) {
    return;  // segments that go on smoothly from a common end touch there
  }
  for (std::size_t k = 0; k < common.count; ++k) {
    const PlanePoint& point = common.points[k];
    const auto is_inside = [&](int piece) {
      const double fraction = fraction_at(shape(piece), point);
      return fraction > 0.0 && fraction < 1.0;
    };
    if (is_inside(i) && is_inside(j) && !has_end(point)) {
      crossings_.add([&] {
        return place_of(point) + " of the segments of line " + std::to_string(one.drawn->line) +
               " and line " + std::to_string(other.drawn->line);
      });
    }
  }
}

void CrossingSearch::compare_all() {
  std::vector<int> order(shapes_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [this](int i, int j) { return box(i).low[0] < box(j).low[0]; });
  for (auto one = order.begin(); one != order.end(); ++one) {
    for (auto other = one + 1; other != order.end() && box(*other).low[0] <= box(*one).high[0]; ++other) {
      WorkLimit::poll();
      const bool apart = box(*other).low[1] > box(*one).high[1] || box(*one).low[1] > box(*other).high[1];
      if (!apart) {
        compare(std::min(*one, *other), std::max(*one, *other));
      }
      if (crossings_.count() >= kMostCrossings) {
        return;
      }
    }
  }
}

void CrossingSearch::run(std::vector<Warning>& warnings) {
  compare_all();
  crossings_.warn("crossings", "crossing of segments has no end and is not joined",
                  crossings_.count() < kMostCrossings
                      ? "crossings of segments have no end and are not joined"
                      : "or more crossings of segments have no end and are not joined",
                  "to join segments, let an end lie where they cross", warnings);
}

}  // namespace

void tell_crossings(const DrawnPieces& drawn, std::vector<Warning>& warnings) {
  CrossingSearch(drawn).run(warnings);
}

}  // namespace snapthrough::api::convert
