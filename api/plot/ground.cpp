#include <algorithm>
#include <cmath>
#include <map>

#include "api/plot/drawing.h"
#include "api/plot/ink.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kHatchSpacing = 9;

struct GroundLine {
  std::vector<Point> points;
  std::vector<Point> directions;
};

/// Returns a surface that has points, side by side, each with the normal into the medium.
GroundLine surface_through(const ModelFoundation& foundation) {
  GroundLine surface;
  for (std::size_t i = 1; i < foundation.line.size(); ++i) {
    WorkLimit::poll();
    const Point& a = foundation.line[i - 1];
    const Point& b = foundation.line[i];
    const auto into = foundation.surface->at({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}).into;
    for (const Point& end : {a, b}) {
      surface.points.push_back(end);
      surface.directions.push_back({into[0], into[1]});
    }
  }
  return surface;
}

/// Returns the undeformed ground surface beside the undeformed axis.
/// @param farthest largest distance that is drawn
GroundLine surface_of(const DrawnMember& member, const ModelFoundation& foundation, double farthest) {
  const double length = member.s.back();
  const auto [from, to] = foundation.range;
  std::vector<double> places{from * length};
  std::copy_if(member.s.begin(), member.s.end(), std::back_inserter(places),
               [&, f = from, t = to](double s) { return s > f * length && s < t * length; });
  places.push_back(to * length);
  GroundLine surface;
  for (const double s : places) {
    const auto [d, gap] = way_into(foundation, member, s);
    const double distance = std::min(gap, farthest);
    surface.directions.push_back(d);
    surface.points.push_back({interpolate(member.s, member.x0, s) + distance * d.x,
                              interpolate(member.s, member.y0, s) + distance * d.y});
  }
  return surface;
}

/// Returns the drawn depth: at most 0.7 of the radius of curvature on a concave side, at least 0.3 `depth`.
double depth_of(const GroundLine& surface, double depth) {
  double least = depth;
  for (std::size_t i = 1; i < surface.points.size(); ++i) {
    const double dx = surface.points[i].x - surface.points[i - 1].x;
    const double dy = surface.points[i].y - surface.points[i - 1].y;
    const double nx = surface.directions[i].x - surface.directions[i - 1].x;
    const double ny = surface.directions[i].y - surface.directions[i - 1].y;
    const double square = dx * dx + dy * dy;
    const double closer = square > 0 ? -(nx * dx + ny * dy) / square : 0;
    if (closer > 0) {
      least = std::min(least, 0.7 / closer);
    }
  }
  return std::max(least, 0.3 * depth);
}

struct Crossing {
  double x;
  int way;
};

/// Returns the x of crossings between a polygon's edges and the lines x + y = k kHatchSpacing, by k.
std::map<long, std::vector<Crossing>> crossings_of(const std::vector<Pixel>& polygon, Size size) {
  std::map<long, std::vector<Crossing>> crossings;
  const double end = size.width + size.height;
  std::size_t found = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Ink::require(2 * found);  // two crossings may give a line of four coordinates
    const Pixel& a = polygon[i];
    const Pixel& b = polygon[(i + 1) % polygon.size()];
    const double from = a.x + a.y;
    const double to = b.x + b.y;
    const double low = std::max(0.0, std::min(from, to));
    const double high = std::min(end, std::max(from, to));
    for (auto k = static_cast<long>(std::ceil(low / kHatchSpacing));
         from != to && static_cast<double>(k) * kHatchSpacing < high; ++k) {
      const double sum = static_cast<double>(k) * kHatchSpacing;
      crossings[k].push_back({a.x + (sum - from) / (to - from) * (b.x - a.x), to > from ? 1 : -1});
      ++found;
    }
  }
  return crossings;
}

/// Returns path data of the hatch lines at 45 degrees inside polygons (non-zero winding rule).
std::string hatch(const std::vector<std::vector<Pixel>>& polygons, Size size) {
  std::string text;
  for (const std::vector<Pixel>& polygon : polygons) {
    for (auto& [k, cuts] : crossings_of(polygon, size)) {
      const double sum = static_cast<double>(k) * kHatchSpacing;
      std::stable_sort(cuts.begin(), cuts.end(),
                       [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
      int winding = 0;
      double begin = 0;
      for (const auto& [x, way] : cuts) {
        if (winding == 0) {
          begin = x;
        } else if (winding + way == 0) {
          const Pixel ends[] = {{begin, sum - begin}, {x, sum - x}};
          text += path_data(ends);
        }
        winding += way;
      }
    }
  }
  return text;
}

std::vector<Pixel> mirrored(std::vector<Pixel> points, double twice) {
  for (Pixel& point : points) {
    point.x = twice - point.x;
  }
  std::reverse(points.begin(), points.end());
  return points;
}

void add_mirrored(std::vector<std::vector<Pixel>>& all, double twice) {
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(mirrored(all[i], twice));
  }
}

/// Returns the reaction drawn as the ground's depth: the largest, but at least 2 % of the line loads and at
/// least the rounding.
double reference_reaction(const Scene& scene) {
  constexpr double kRounding = 1e-6;  // share of axial force / extent below which a reaction is zero
  double largest = 0;
  if (scene.input.model != nullptr) {
    for (const ModelLoad& load : scene.input.model->loads) {
      const bool distributed = load.type == ModelLoad::Type::distributed;
      const double size = distributed ? std::hypot(load.force.x, load.force.y) : std::abs(load.value);
      if (distributed || load.type == ModelLoad::Type::pressure) {
        largest = std::max(largest, 0.02 * size * std::abs(scene.load_factor()));
      }
    }
  }
  for (const auto& [id, member] : scene.input.state->members) {
    for (const double force : member.axial_force) {
      largest = std::max(largest, kRounding * std::abs(force) / scene.extent);
    }
  }
  for (const auto& [id, foundation] : scene.input.state->foundations) {
    for (const double value : foundation.reaction) {
      largest = std::max(largest, std::abs(value));
    }
  }
  return largest;
}

struct Profile {
  std::vector<Pixel> base;
  std::vector<Pixel> tips;
  Pixel peak;
  double value = 0;  ///< signed value of the largest |reaction|
};

Profile profile_of(const View& view, const ModelFoundation& foundation, const DrawnMember& member,
                   const FoundationState& state, double scale) {
  Profile profile;
  for (std::size_t i = 0; i < state.s.size(); ++i) {
    const double s = state.s[i];
    const Point d = way_into(foundation, member, s).into;
    const Point p{interpolate(member.s, member.x, s), interpolate(member.s, member.y, s)};
    const double value = state.reaction[i];
    profile.base.push_back(to_pixel(view, p));
    profile.tips.push_back(to_pixel(view, {p.x + scale * value * d.x, p.y + scale * value * d.y}));
    if (std::abs(value) > std::abs(profile.value)) {
      profile.value = value;
      profile.peak = profile.tips.back();
    }
  }
  return profile;
}

}  // namespace

Shape ground_shape(const Scene& scene, const View& view, Size size) {
  std::vector<std::vector<Pixel>> bands;
  std::vector<std::vector<Pixel>> surfaces;
  std::size_t collected = 0;
  const std::vector<ModelFoundation> none;
  for (const ModelFoundation& foundation : scene.input.model != nullptr ? scene.foundations : none) {
    const DrawnMember* member = scene.member(foundation.member);
    if (member == nullptr) {
      continue;
    }
    const GroundLine surface =
        foundation.line.empty() ? surface_of(*member, foundation, scene.extent) : surface_through(foundation);
    const double depth = depth_of(surface, scene.depth);
    collected += surface.points.size();
    Ink::require(6 * collected);  // one point at the surface's line, two at its band
    std::vector<Pixel> inner;
    std::vector<Pixel> outer;
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
      const Point& p = surface.points[i];
      const Point& d = surface.directions[i];
      inner.push_back(to_pixel(view, p));
      outer.push_back(to_pixel(view, {p.x + depth * d.x, p.y + depth * d.y}));
    }
    surfaces.push_back(inner);
    inner.insert(inner.end(), outer.rbegin(), outer.rend());
    bands.push_back(std::move(inner));
  }
  if (scene.mirror) {
    const double twice = 2 * to_pixel(view, {*scene.mirror, 0}).x;
    add_mirrored(bands, twice);
    add_mirrored(surfaces, twice);
  }
  std::vector<Shape> shapes;
  shapes.reserve(bands.size() + surfaces.size() + 1);
  for (const std::vector<Pixel>& band : bands) {
    shapes.push_back(path("ground-body", band, true));
  }
  if (!bands.empty()) {
    shapes.push_back(path_of("ground-hatch", hatch(bands, size)));
  }
  for (const std::vector<Pixel>& surface : surfaces) {
    shapes.push_back(path("ground-surface", surface));
  }
  return group("ground", std::move(shapes));
}

Part reaction_part(const Scene& scene, const View& view, Occupancy& taken) {
  Part part;
  if (scene.input.state == nullptr) {
    return part;
  }
  const double reference = reference_reaction(scene);
  std::optional<Profile> largest;
  for (const ModelFoundation& foundation : scene.foundations) {
    const DrawnMember* member = scene.member(foundation.member);
    const auto state = scene.input.state->foundations.find(foundation.id);
    if (member == nullptr || state == scene.input.state->foundations.end() || !(reference > 0)) {
      continue;
    }
    Profile profile = profile_of(view, foundation, *member, state->second, 0.85 * scene.depth / reference);
    std::vector<Pixel> area = profile.base;
    area.insert(area.end(), profile.tips.rbegin(), profile.tips.rend());
    part.shapes.push_back(path("reaction", area, true));
    part.shapes.push_back(path("reaction-line", profile.tips));
    taken.add_line(profile.tips, 3);
    if (std::abs(profile.value) > 0.02 * reference &&
        (!largest || std::abs(profile.value) > std::abs(largest->value))) {
      largest = std::move(profile);
    }
  }
  if (largest) {
    LabelRequest wanted;
    wanted.at = largest->peak;
    wanted.runs = {
        {"r = " + with_unit(largest->value, unit_of(scene.input.units, Quantity::line_load), 3), "", true}};
    wanted.looks = "contact-text";
    wanted.tolerance = 400;
    wanted.leader = true;
    part.labels.push_back(std::move(wanted));
  }
  return part;
}

std::vector<Shape> contact_shapes(const Scene& scene, const View& view) {
  std::vector<Shape> shapes;
  for (const ModelFoundation& foundation : scene.foundations) {
    const DrawnMember* member = scene.member(foundation.member);
    if (scene.input.state == nullptr || member == nullptr || !foundation.one_sided) {
      continue;
    }
    const auto state = scene.input.state->foundations.find(foundation.id);
    if (state == scene.input.state->foundations.end()) {
      continue;
    }
    for (const auto& [from, to] : state->second.contact) {
      std::vector<double> places{from};
      const auto first = std::upper_bound(member->s.begin(), member->s.end(), from);
      const auto last = std::lower_bound(first, member->s.end(), to);
      places.insert(places.end(), first, last);
      places.push_back(to);
      std::vector<Pixel> points;
      points.reserve(places.size());
      for (const double s : places) {
        points.push_back(
            to_pixel(view, {interpolate(member->s, member->x, s), interpolate(member->s, member->y, s)}));
      }
      shapes.push_back(path("contact", points));
    }
  }
  return shapes;
}

}  // namespace snapthrough::api::plot
