#include <cmath>
#include <numbers>

#include "api/plot/drawing.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTriangle = 13;  // pixels; height of a support triangle
constexpr double kSpringLength = 34;

/// Pixel axes of a symbol: `out` points away from the structure, `along` is `out` turned by 90 degrees.
struct SymbolAxes {
  Pixel at;
  Point out;
  Point along;

  [[nodiscard]] Pixel offset(double far, double side) const {
    return {at.x + far * out.x + side * along.x, at.y + far * out.y + side * along.y};
  }
};

SymbolAxes axes_at(Pixel at, double angle) {
  return {at, {std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
}

/// Draws a line across `out` at a distance in pixels, with ground hatching behind it.
void add_ground_line(std::vector<Shape>& shapes, const SymbolAxes& axes, double distance, double half) {
  std::string strokes;
  for (double a = -half + 2; a <= half; a += 5) {
    const Pixel ends[] = {axes.offset(distance, a), axes.offset(distance + 5, a - 4)};
    strokes += path_data(ends);
  }
  shapes.push_back(line("support", axes.offset(distance, -half), axes.offset(distance, half)));
  shapes.push_back(path_of("support-hatch", strokes));
}

void add_triangle(std::vector<Shape>& shapes, const SymbolAxes& axes) {
  const Pixel corners[] = {axes.offset(0, 0), axes.offset(kTriangle, -8), axes.offset(kTriangle, 8)};
  shapes.push_back(path("support-body", corners, true));
}

void add_rollers(std::vector<Shape>& shapes, const SymbolAxes& axes, double distance, double half) {
  for (const double a : {-half, 0.0, half}) {
    shapes.push_back(circle("support-body", axes.offset(distance, a), 2));
  }
}

/// Returns `angle` or its opposite (rad, y down), whichever points more away from the members, down (weight
/// 1.1) and left (weight 0.2).
double outward(double angle, const Joint& joint) {
  const auto score = [&](double a) {
    double away = 0;
    for (const Point& t : joint.leaving) {
      away -= t.x * std::cos(a) - t.y * std::sin(a);
    }
    return away / std::max<double>(1, static_cast<double>(joint.leaving.size())) + 1.1 * std::sin(a) -
           0.2 * std::cos(a);
  };
  return score(angle) >= score(angle + kPi) ? angle : angle + kPi;
}

/// Returns the angle of `out` for a clamp: opposite to the mean tangent of members; down for a mean of zero.
double clamp_angle(const Joint& joint) {
  double x = 0;
  double y = 0;
  for (const Point& t : joint.leaving) {
    x += t.x;
    y += t.y;
  }
  return std::hypot(x, y) < 0.1 ? kPi / 2 : std::atan2(y, -x);
}

Shape support_shape(const ModelSupport& support, const Joint& joint, Pixel at) {
  const double turn = -support.angle * kPi / 180;  // y of pixels points down
  std::vector<Shape> shapes;
  if (support.x && support.y) {
    const SymbolAxes axes =
        axes_at(at, support.rotation ? clamp_angle(joint) : outward(kPi / 2 + turn, joint));
    if (support.rotation) {
      const Pixel bar[] = {axes.offset(0, -11), axes.offset(0, 11)};
      shapes.push_back(path("support-bar", bar));
      add_ground_line(shapes, axes, 1, 11);
    } else {
      add_triangle(shapes, axes);
      add_ground_line(shapes, axes, kTriangle, 12);
    }
  } else if (support.x || support.y) {
    const SymbolAxes axes = axes_at(at, outward((support.y ? kPi / 2 : kPi) + turn, joint));
    if (support.rotation) {
      shapes.push_back(line("support", axes.offset(3, -9), axes.offset(3, 9)));
      add_rollers(shapes, axes, 6, 6);
      add_ground_line(shapes, axes, 9, 11);
    } else {
      add_triangle(shapes, axes);
      add_rollers(shapes, axes, kTriangle + 3, 5);
      add_ground_line(shapes, axes, kTriangle + 6, 12);
    }
  } else {
    const SymbolAxes axes = axes_at(at, kPi / 2);
    const Pixel corners[] = {axes.offset(-6, -6), axes.offset(6, -6), axes.offset(6, 6), axes.offset(-6, 6)};
    shapes.push_back(path("support-body", corners, true));
  }
  return group("support-symbol", std::move(shapes));
}

std::vector<Pixel> zigzag(const SymbolAxes& axes, double near, double far) {
  constexpr int kTurns = 6;
  std::vector<Pixel> points{axes.offset(near, 0), axes.offset(near + 4, 0)};
  const double pitch = (far - near - 8) / kTurns;
  for (int i = 0; i < kTurns; ++i) {
    points.push_back(axes.offset(near + 4 + (i + 0.5) * pitch, i % 2 == 0 ? 5 : -5));
  }
  points.push_back(axes.offset(far - 4, 0));
  points.push_back(axes.offset(far, 0));
  return points;
}

Shape spiral(Pixel centre, const std::string& looks) {
  constexpr int kPoints = 48;
  std::vector<Pixel> points;
  for (int i = 0; i <= kPoints; ++i) {
    const double share = static_cast<double>(i) / kPoints;
    const double radius = 2 + share * 11;
    points.push_back(
        {centre.x + radius * std::cos(share * 4.5 * kPi), centre.y + radius * std::sin(share * 4.5 * kPi)});
  }
  std::vector<Shape> shapes{path(looks, points)};
  add_ground_line(shapes, axes_at(points.back(), 0), 0, 7);
  return group("spring-symbol", std::move(shapes));
}

/// A spring between two places of the structure, which both move.
Shape shape_between(Pixel from, Pixel to, const std::string& looks, Occupancy& taken) {
  const SymbolAxes axes = axes_at(from, std::atan2(to.y - from.y, to.x - from.x));
  const Pixel ends[] = {from, to};
  taken.add_line(ends, 30);
  return group("spring-symbol", {path(looks, zigzag(axes, 0, std::hypot(to.x - from.x, to.y - from.y)))});
}

std::string looks_of(const ModelSpring& spring, bool closed) {
  return spring.one_sided && closed ? "contact-spring" : "spring";
}

Shape spring_shape(const ModelSpring& spring, const Place& place, bool closed, const View& view,
                   Occupancy& taken) {
  const std::string looks = looks_of(spring, closed);
  const Pixel tip = to_pixel(view, place.moved);
  if (!spring.direction) {
    return spiral(tip, looks);
  }
  // the far end of a spring does not move: its position follows from the undeformed structure
  const Pixel still = to_pixel(view, place.still);
  SymbolAxes axes = axes_at(still, std::atan2(-spring.direction->y, spring.direction->x));
  const double gap = std::min(spring.gap * view.scale, 60.0);
  const double moved = (tip.x - still.x) * axes.out.x + (tip.y - still.y) * axes.out.y;
  const bool touches = !spring.one_sided || closed;
  const double near = touches ? std::min(moved, gap + kSpringLength - 8) : gap;
  const double far = gap + kSpringLength;
  if (touches) {
    axes.at = {tip.x - moved * axes.out.x, tip.y - moved * axes.out.y};
  }
  const Pixel middle[] = {axes.offset(near + 6, 0), axes.offset(far, 0)};
  taken.add_line(middle, 30);
  std::vector<Shape> shapes{path(looks, zigzag(axes, near, far))};
  if (spring.one_sided) {
    shapes.push_back(line(looks, axes.offset(near, -5), axes.offset(near, 5)));
  }
  add_ground_line(shapes, axes, far, 9);
  return group("spring-symbol", std::move(shapes));
}

}  // namespace

std::vector<Shape> support_shapes(const Scene& scene, const View& view, Occupancy& taken) {
  std::vector<Shape> shapes;
  if (scene.input.model == nullptr) {
    return shapes;
  }
  for (const ModelSupport& support : scene.input.model->supports) {
    const auto joint = scene.joints.find(support.node);
    if (joint != scene.joints.end()) {
      const Pixel at = to_pixel(view, joint->second.moved);
      taken.add_box({at.x - 14, at.y - 4, at.x + 14, at.y + 18}, 12);
      shapes.push_back(support_shape(support, joint->second, at));
    }
  }
  return shapes;
}

std::vector<Shape> spring_shapes(const Scene& scene, const View& view, Occupancy& taken) {
  std::vector<Shape> shapes;
  if (scene.input.model == nullptr) {
    return shapes;
  }
  for (const ModelSpring& spring : scene.input.model->springs) {
    if (const std::optional<Place> place = place_of(scene, spring.at)) {
      bool closed = !spring.one_sided;
      if (scene.input.state != nullptr) {
        const auto found = scene.input.state->springs.find(spring.id);
        closed = found == scene.input.state->springs.end() ? closed : found->second.closed;
      }
      const std::optional<Place> other = spring.to ? place_of(scene, *spring.to) : std::nullopt;
      shapes.push_back(other ? shape_between(to_pixel(view, place->moved), to_pixel(view, other->moved),
                                             looks_of(spring, closed), taken)
                             : spring_shape(spring, *place, closed, view, taken));
    }
  }
  return shapes;
}

std::vector<Shape> hinge_shapes(const Scene& scene, const View& view) {
  std::vector<Shape> shapes;
  if (scene.input.model == nullptr) {
    return shapes;
  }
  for (const ModelMember& member : scene.input.model->members) {
    const DrawnMember* drawn = scene.member(member.id);
    for (const bool start : {true, false}) {
      if (!(start ? member.hinge_at_start : member.hinge_at_end)) {
        continue;
      }
      const std::size_t i = start ? 0 : drawn->s.size() - 1;
      const std::size_t next = start ? 1 : drawn->s.size() - 2;
      const Pixel p = to_pixel(view, {drawn->x[i], drawn->y[i]});
      const Pixel q = to_pixel(view, {drawn->x[next], drawn->y[next]});
      const double length = std::hypot(q.x - p.x, q.y - p.y);
      const double share = length > 0 ? 5 / length : 0;
      shapes.push_back(circle("hinge", {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)}, 3.5));
    }
  }
  return shapes;
}

}  // namespace snapthrough::api::plot
