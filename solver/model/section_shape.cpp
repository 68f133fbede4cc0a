#include "solver/model/section_shape.h"

#include <numbers>

namespace snapthrough {

SectionGeometry rectangle(double width, double depth) {
  const double area = width * depth;
  return {area, area * depth * depth / 12.0, 5.0 / 6.0 * area};
}

SectionGeometry tube(double diameter, double thickness) {
  const double inner = diameter - 2.0 * thickness;
  const double area = std::numbers::pi * thickness * (diameter - thickness);
  // Cowper: k = 6 (1 + m^2)^2 / (7 (1 + m^2)^2 + 20 m^2),  m = inner / outer diameter
  const double m = inner / diameter;
  const double sum = (1.0 + m * m) * (1.0 + m * m);
  return {area, area * (diameter * diameter + inner * inner) / 16.0,
          area * 6.0 * sum / (7.0 * sum + 20.0 * m * m)};
}

SectionGeometry i_section(const ISection& section) {
  const auto [depth, width, web, flange, r] = section;
  const double clear = depth - 2.0 * flange;
  // a fillet is a square of side r less a quarter of a circle; its centroid lies at `offset` from the corner
  const double fillet = (1.0 - std::numbers::pi / 4.0) * r * r;
  const double offset = r * (10.0 - 3.0 * std::numbers::pi) / (12.0 - 3.0 * std::numbers::pi);
  const double own = r * r * r * r *
                     (1.0 / 3.0 - std::numbers::pi / 16.0 -
                      1.0 / (36.0 * (1.0 - std::numbers::pi / 4.0)));  // about the centroid of the fillet
  const double arm = 0.5 * clear - offset;
  SectionGeometry out;
  out.area = 2.0 * width * flange + web * clear + 4.0 * fillet;
  out.second_moment = (width * depth * depth * depth - (width - web) * clear * clear * clear) / 12.0 +
                      4.0 * (own + fillet * arm * arm);
  // Cowper, thin walls of height h between the centres of the flanges:
  // k = 10 (1 + 3 m)^2 / (12 + 72 m + 150 m^2 + 90 m^3 + 30 n^2 (m + m^2)),  m = 2 b t_f / (h t_w),  n = b /
  // h
  const double h = depth - flange;
  const double m = 2.0 * width * flange / (h * web);
  const double n = width / h;
  const double below = 12.0 + m * (72.0 + m * (150.0 + 90.0 * m)) + 30.0 * n * n * m * (1.0 + m);
  out.shear_area = (1.0 + m) * h * web * 10.0 * (1.0 + 3.0 * m) * (1.0 + 3.0 * m) / below;
  return out;
}

ISection scaled(const ISection& section, double factor) {
  return {section.depth * factor, section.width * factor, section.web * factor, section.flange * factor,
          section.root_radius * factor};
}

}  // namespace snapthrough
