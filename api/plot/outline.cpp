#include "api/plot/outline.h"

#include <cmath>
#include <vector>

namespace snapthrough::api::plot {
namespace {

std::array<double, 2> read_pair(const Field& field) {
  const std::vector<double> pair = field.numbers(2);
  return {pair[0], pair[1]};
}

Outline read_circle(const Field& field) {
  CircleOutline out;
  out.centre = read_pair(field.at("center"));
  out.radius = field.at("radius").number();
  if (!(out.radius > 0)) {
    field.at("radius").fail("must be positive");
  }
  out.medium_inside = field.at("medium").text() == "inside";
  return out;
}

Outline read_line(const Field& field) {
  LineOutline out;
  out.through = read_pair(field.at("through"));
  out.into = read_pair(field.at("into"));
  if (!(std::hypot(out.into[0], out.into[1]) > 0)) {
    field.at("into").fail("must not be zero");
  }
  return out;
}

/// Straight lines between points; a plot draws splines and rounded corners so.
Outline read_points(const Field& field) {
  PolylineOutline out;
  const Field points = field.at("points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.points.push_back(read_pair(points.item(i)));
    if (i > 0 && out.points[i] == out.points[i - 1]) {
      points.item(i).fail("must differ from the point before");
    }
  }
  if (out.points.size() < 2) {
    points.fail("must have at least two points");
  }
  out.medium = field.at("medium").text() == "right" ? Side::right : Side::left;
  return out;
}

}  // namespace

std::shared_ptr<const Surface> read_outline(const Field& field) {
  const std::string type = field.at("type").text();
  const Outline outline = type == "circle" ? read_circle(field)
                          : type == "line" ? read_line(field)
                                           : read_points(field);
  return make_surface(outline, {0, 0}, 1);
}

}  // namespace snapthrough::api::plot
