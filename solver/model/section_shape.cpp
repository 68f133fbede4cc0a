#include "solver/model/section_shape.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace snapthrough {

namespace {

/// Corner of an outline, rounded with a radius.
struct Corner {
  double x = 0.0;
  double y = 0.0;
  double radius = 0.0;
};

/// Area and second moment about y = 0 inside an outline, as sums over its edges and arcs (Green's theorem):
/// area = (1/2) sum int (x dy - y dx),  second moment = -(1/3) sum int y^3 dx.
struct Enclosed {
  double area = 0.0;
  double second_moment = 0.0;

  void add_edge(double x, double y, double to_x, double to_y) {
    area += 0.5 * (x * to_y - to_x * y);
    second_moment -= (to_x - x) * (y + to_y) * (y * y + to_y * to_y) / 12.0;
  }
  /// Adds the arc x = cx + r cos(t), y = cy + r sin(t), t from `from` to `to`.
  void add_arc(double cx, double cy, double r, double from, double to) {
    const double c = std::cos(to) - std::cos(from);
    const double s = std::sin(to) - std::sin(from);
    const double c3 = std::pow(std::cos(to), 3) - std::pow(std::cos(from), 3);
    const double s2 = std::sin(2.0 * to) - std::sin(2.0 * from);
    const double s4 = std::sin(4.0 * to) - std::sin(4.0 * from);
    const double t = to - from;
    area += 0.5 * r * (cx * s - cy * c + r * t);
    // integrals of sin, sin^2, sin^3 and sin^4
    second_moment += r / 3.0 *
                     (cy * cy * cy * -c + 3.0 * cy * cy * r * (0.5 * t - 0.25 * s2) +
                      3.0 * cy * r * r * (c3 / 3.0 - c) + r * r * r * (0.375 * t - 0.25 * s2 + s4 / 32.0));
  }
};

/// Unit vector from a corner to another one; zero between corners in one place.
std::array<double, 2> direction(const Corner& from, const Corner& to) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length == 0.0) return {0.0, 0.0};
  return {(to.x - from.x) / length, (to.y - from.y) / length};
}

/// @brief Area and second moment about y = 0 inside an outline of straight edges with rounded corners.
/// @param corners anticlockwise; their roundings do not meet, and the last corner has none
Enclosed enclosed(std::span<const Corner> corners) {
  const std::size_t count = corners.size();
  Enclosed out;
  // where the edge before the next corner begins
  double x = corners[count - 1].x;
  double y = corners[count - 1].y;
  for (std::size_t i = 0; i < count; ++i) {
    const Corner& at = corners[i];
    const auto u = direction(corners[(i + count - 1) % count], at);
    const auto v = direction(at, corners[(i + 1) % count]);
    const double turn = std::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    const double cut = at.radius * std::tan(0.5 * std::abs(turn));
    out.add_edge(x, y, at.x - cut * u[0], at.y - cut * u[1]);
    if (at.radius > 0.0) {
      const double side = std::copysign(at.radius, turn);  // to the centre, along the left normal of the edge
      const double from = std::atan2(-side * u[0], side * u[1]);
      out.add_arc(at.x - cut * u[0] - side * u[1], at.y - cut * u[1] + side * u[0], at.radius, from,
                  from + turn);
    }
    x = at.x + cut * v[0];
    y = at.y + cut * v[1];
  }
  return out;
}

/// Shear area of thin walls whose web has the height h between the centres of the flanges, and flanges that
/// reach l from the centre of the web on one or both sides. The shear flow q of a force 1 gives
/// 1 / int q^2 / t, which is Cowper's k A for Poisson's ratio 0:
/// k = 10 (1 + 3 m)^2 / (12 + 72 m + 150 m^2 + 90 m^3 + 120 (l / h)^2 m (1 + m)),  m = 2 A_flange / (h t_w).
double thin_walled_shear_area(const FlangedSection& section) {
  const double h = section.depth - section.flange;
  const double l = section.channel ? section.width - 0.5 * section.web : 0.5 * section.width;
  const double flange = (section.channel ? l : section.width) * section.flange;
  const double m = 2.0 * flange / (h * section.web);
  const double below = 12.0 + m * (72.0 + m * (150.0 + 90.0 * m)) + 120.0 * l * l / (h * h) * m * (1.0 + m);
  return (1.0 + m) * h * section.web * 10.0 * (1.0 + 3.0 * m) * (1.0 + 3.0 * m) / below;
}

}  // namespace

SectionGeometry rectangle(double width, double depth) {
  const double area = width * depth;
  return {area, area * depth * depth / 12.0, 5.0 / 6.0 * area, depth};
}

SectionGeometry tube(double diameter, double thickness) {
  const double inner = diameter - 2.0 * thickness;
  const double area = std::numbers::pi * thickness * (diameter - thickness);
  // Cowper: k = 6 (1 + m^2)^2 / (7 (1 + m^2)^2 + 20 m^2),  m = inner / outer diameter
  const double m = inner / diameter;
  const double sum = (1.0 + m * m) * (1.0 + m * m);
  return {area, area * (diameter * diameter + inner * inner) / 16.0,
          area * 6.0 * sum / (7.0 * sum + 20.0 * m * m), diameter};
}

SectionGeometry flanged_section(const FlangedSection& section) {
  // A half of a channel or a quarter of an I section, from the back or the centre of the web and the axis of
  // bending to the tip of a flange:
  //   y ^  +----------------+
  //     |  |    ____________/
  //     |  |   (
  //     |  |   |
  //     +--+---+------------> x
  const double copies = section.channel ? 2.0 : 4.0;
  const double web = section.channel ? section.web : 0.5 * section.web;
  const double tip = section.channel ? section.width : 0.5 * section.width;
  const double top = 0.5 * section.depth;
  const double at_tip = section.flange - section.slope * section.flange_at;
  const double at_web = at_tip + section.slope * (tip - web);
  const std::array<Corner, 6> outline = {{{0.0, 0.0, 0.0},
                                          {web, 0.0, 0.0},
                                          {web, top - at_web, section.root_radius},
                                          {tip, top - at_tip, section.toe_radius},
                                          {tip, top, 0.0},
                                          {0.0, top, 0.0}}};
  const Enclosed part = enclosed(outline);
  return {copies * part.area, copies * part.second_moment, thin_walled_shear_area(section), section.depth};
}

FlangedSection scaled(const FlangedSection& section, double factor) {
  FlangedSection out = section;
  for (double* length :
       {&out.depth, &out.width, &out.web, &out.flange, &out.root_radius, &out.flange_at, &out.toe_radius})
    *length *= factor;
  return out;
}

}  // namespace snapthrough
