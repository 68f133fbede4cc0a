#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "api/plot/drawing.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kPointArrow = 46;  // pixels; length of the arrow of the largest load
constexpr double kLineArrow = 26;
constexpr double kLineSpacing = 30;
constexpr double kHead = 8;

/// Arrows as two SVG paths, one for all shafts and one for all heads, and the texts beside them.
struct Arrows {
  std::string lines;
  std::string heads;
  struct Note {
    Pixel at;
    std::string text;
    double size;  ///< size of the load; largest first
  };
  std::vector<Note> notes;
  std::vector<std::pair<Pixel, Pixel>> drawn;

  void add(Pixel tail, Pixel tip);
};

void Arrows::add(Pixel tail, Pixel tip) {
  const double length = std::hypot(tip.x - tail.x, tip.y - tail.y);
  if (!(length > 2)) {
    return;
  }
  const double ux = (tip.x - tail.x) / length;
  const double uy = (tip.y - tail.y) / length;
  const double head = std::min(kHead, 0.6 * length);
  const Pixel neck{tip.x - head * ux, tip.y - head * uy};
  const double half = 0.42 * head;
  drawn.emplace_back(tail, tip);
  const Pixel shaft[] = {tail, neck};
  const Pixel point[] = {
      tip, {neck.x - half * uy, neck.y + half * ux}, {neck.x + half * uy, neck.y - half * ux}};
  lines += path_data(shaft);
  heads += path_data(point, true);
}

/// Largest sizes of loads, which the lengths of arrows are relative to.
struct LoadScene {
  const Scene& scene;
  const View& view;
  double largest_point = 0;
  double largest_line = 0;

  [[nodiscard]] double factor(const ModelLoad& load) const { return load.constant ? 1 : scene.load_factor(); }
  /// Returns the sign of the load's factor; 1 for a factor of zero, so that the arrow shows the load itself.
  [[nodiscard]] double sense(const ModelLoad& load) const { return factor(load) < 0 ? -1 : 1; }
  [[nodiscard]] std::string text(double value, Quantity quantity) const {
    return with_unit(value, unit_of(scene.input.units, quantity));
  }
};

void add_moment(Pixel centre, bool counter_clockwise, Arrows& arrows) {
  constexpr double kRadius = 17;
  constexpr int kPoints = 24;
  std::vector<Pixel> points;
  for (int i = 0; i <= kPoints; ++i) {
    const double turn = (-150 + i * 270.0 / kPoints) * std::numbers::pi / 180;
    const double angle = counter_clockwise ? -turn : turn + std::numbers::pi;
    points.push_back({centre.x + kRadius * std::cos(angle), centre.y + kRadius * std::sin(angle)});
  }
  arrows.lines += path_data(std::span(points).first(points.size() - 3));
  arrows.add(points[points.size() - 4], points.back());
}

/// Returns a force turned as the member's axis has turned at a place since it was undeformed.
Point turned(const Point& force, const Place& place) {
  const Point still{place.normal.y, -place.normal.x};
  const double cosine = still.x * place.tangent.x + still.y * place.tangent.y;
  const double sine = still.x * place.tangent.y - still.y * place.tangent.x;
  return {cosine * force.x - sine * force.y, sine * force.x + cosine * force.y};
}

/// The place nearest to a displaced one on the line of a force through the undeformed one.
Point foot_on_line(const Place& place, const Point& force) {
  const Point moved{place.moved.x - place.still.x, place.moved.y - place.still.y};
  const double share = (moved.x * force.x + moved.y * force.y) / (force.x * force.x + force.y * force.y);
  return {place.still.x + share * force.x, place.still.y + share * force.y};
}

void point_arrow(const ModelLoad& load, const LoadScene& all, Arrows& arrows) {
  const std::optional<Place> place = place_of(all.scene, load.at);
  if (!place) {
    return;
  }
  const Pixel at = to_pixel(all.view, place->moved);
  const Point force = load.follows ? turned(load.force, *place) : load.force;
  const double size = std::hypot(force.x, force.y);
  if (size > 0) {
    const Pixel tip = load.fixed_line ? to_pixel(all.view, foot_on_line(*place, load.force)) : at;
    if (load.fixed_line) {
      arrows.lines += path_data(std::array{at, tip});
    }
    const double ux = all.sense(load) * force.x / size;
    const double uy = -all.sense(load) * force.y / size;
    const double length = kPointArrow * std::max(0.45, size / all.largest_point);
    const Pixel tail{tip.x - length * ux, tip.y - length * uy};
    arrows.add(tail, {tip.x - 3 * ux, tip.y - 3 * uy});
    arrows.notes.push_back({tail, all.text(std::abs(all.factor(load)) * size, Quantity::force), size});
  }
  if (load.moment != 0) {
    add_moment(at, load.moment * all.sense(load) > 0, arrows);
    arrows.notes.push_back({{at.x + 14, at.y - 14},
                            all.text(std::abs(all.factor(load) * load.moment), Quantity::moment),
                            std::abs(load.moment)});
  }
}

/// Draws arrows along a member. `pull` returns the load at a place and a fraction in model axes, relative to
/// the largest load. Returns the highest tail.
std::optional<Pixel> line_arrows(const DrawnMember& member, const std::array<double, 2>& range,
                                 const LoadScene& all, const std::function<Point(const Place&, double)>& pull,
                                 Arrows& arrows) {
  const double length = member.s.back();
  const double pixels = (range[1] - range[0]) * length * all.view.scale;
  const double count = std::clamp(std::round(pixels / kLineSpacing), 2.0, 60.0);
  std::optional<Pixel> highest;
  for (double i = 0; i <= count; ++i) {
    const double fraction = range[0] + (range[1] - range[0]) * i / count;
    const Place place = place_on(member, fraction * length);
    const Point q = pull(place, fraction);
    const Pixel tip = to_pixel(all.view, place.moved);
    const Pixel tail{tip.x - kLineArrow * q.x, tip.y + kLineArrow * q.y};
    arrows.add(tail, {tip.x - 2.5 * q.x, tip.y + 2.5 * q.y});
    if (!highest || tail.y < highest->y) {
      highest = tail;
    }
  }
  return highest;
}

/// Returns the force of a distributed load at a fraction of its member, in the axes of the load.
Point force_at(const ModelLoad& load, double fraction) {
  if (load.force_along.empty()) {
    return load.force;
  }
  const auto next = std::find_if(load.force_along.begin(), load.force_along.end(),
                                 [fraction](const auto& point) { return point[0] > fraction; });
  const auto& after = next == load.force_along.end() ? load.force_along.back() : *next;
  const auto& before = next == load.force_along.begin() ? after : *(next - 1);
  const double width = after[0] - before[0];
  const double share = width > 0 ? (fraction - before[0]) / width : 0;
  return {before[1] + share * (after[1] - before[1]), before[2] + share * (after[2] - before[2])};
}

void distributed_arrows(const ModelLoad& load, const LoadScene& all, Arrows& arrows) {
  const DrawnMember* member = all.scene.member(load.at.member);
  const double size = std::hypot(load.force.x, load.force.y);
  if (member == nullptr || size == 0) {
    return;
  }
  const double scale = all.sense(load) * std::max(0.5, size / all.largest_line) / size;
  const auto pull = [&](const Place& place, double fraction) {
    const double share = load.per == "horizontal" ? std::abs(place.normal.y)
                         : load.per == "vertical" ? std::abs(place.normal.x)
                                                  : 1;
    Point q = force_at(load, fraction);
    if (load.member_axes) {
      q = {q.x * place.tangent.x + q.y * place.normal.x, q.x * place.tangent.y + q.y * place.normal.y};
    }
    return Point{share * scale * q.x, share * scale * q.y};
  };
  if (const std::optional<Pixel> top = line_arrows(*member, load.range, all, pull, arrows)) {
    arrows.notes.push_back({*top, all.text(std::abs(all.factor(load)) * size, Quantity::line_load), size});
  }
}

void pressure_arrows(const ModelLoad& load, const LoadScene& all, Arrows& arrows) {
  const DrawnMember* member = all.scene.member(load.at.member);
  if (member == nullptr || load.value == 0) {
    return;
  }
  // a pressure on the left side pushes along the right normal (ty, -tx)
  const double scale = load.side * all.sense(load) * (load.value < 0 ? -1 : 1) *
                       std::max(0.5, std::abs(load.value) / all.largest_line);
  const auto pull = [&](const Place& place, double fraction) {
    const double share = load.force_along.empty() ? 1 : force_at(load, fraction).x / load.value;
    return Point{share * scale * place.tangent.y, -share * scale * place.tangent.x};
  };
  if (const std::optional<Pixel> top = line_arrows(*member, {0, 1}, all, pull, arrows)) {
    arrows.notes.push_back(
        {*top, all.text(std::abs(all.factor(load) * load.value), Quantity::line_load), std::abs(load.value)});
  }
}

void strain_note(const ModelLoad& load, const LoadScene& all, Arrows& arrows) {
  const DrawnMember* member = all.scene.member(load.at.member);
  if (member == nullptr) {
    return;
  }
  std::string text;
  const auto add = [&](const std::string& name, double value) {
    if (value != 0) {
      text += (text.empty() ? "" : ", ") + name +
              (std::isnan(value) ? " that varies" : " " + format_number(all.factor(load) * value, 3));
    }
  };
  const bool is_strain = load.type == ModelLoad::Type::initial_strain;
  add(is_strain ? "initial strain" : "temperature", load.axial);
  add(is_strain ? "initial curvature" : "temperature gradient", load.curvature);
  arrows.notes.push_back({to_pixel(all.view, place_on(*member, 0.35 * member->s.back()).moved), text, 0});
}

/// Returns at most four labels with different texts, largest loads first.
std::vector<LabelRequest> notes_of(Arrows& arrows, const std::string& looks) {
  constexpr std::size_t kMost = 4;
  std::stable_sort(arrows.notes.begin(), arrows.notes.end(),
                   [](const Arrows::Note& a, const Arrows::Note& b) { return a.size > b.size; });
  std::set<std::string> seen;
  std::vector<LabelRequest> labels;
  for (const Arrows::Note& note : arrows.notes) {
    if (!note.text.empty() && labels.size() < kMost && seen.insert(note.text).second) {
      LabelRequest wanted{note.at, {{note.text, "", false}}, looks};
      wanted.prefer = 0;
      wanted.tolerance = 90;
      labels.push_back(std::move(wanted));
    }
  }
  return labels;
}

void take_room(const Arrows& arrows, Occupancy& taken) {
  for (const auto& [tail, tip] : arrows.drawn) {
    const Pixel ends[] = {tail, tip};
    taken.add_line(ends, 20);
  }
}

}  // namespace

Part load_part(const Scene& scene, const View& view, Occupancy& taken) {
  Part part;
  if (scene.input.model == nullptr) {
    return part;
  }
  LoadScene all{scene, view};
  for (const ModelLoad& load : scene.input.model->loads) {
    const double size = std::hypot(load.force.x, load.force.y);
    double& largest = load.type == ModelLoad::Type::point ? all.largest_point : all.largest_line;
    largest = std::max({largest, size, std::abs(load.value)});
  }
  Arrows arrows;
  for (const ModelLoad& load : scene.input.model->loads) {
    switch (load.type) {
      case ModelLoad::Type::point:
        point_arrow(load, all, arrows);
        break;
      case ModelLoad::Type::distributed:
        distributed_arrows(load, all, arrows);
        break;
      case ModelLoad::Type::pressure:
        pressure_arrows(load, all, arrows);
        break;
      case ModelLoad::Type::initial_strain:
      case ModelLoad::Type::temperature:
        strain_note(load, all, arrows);
        break;
      case ModelLoad::Type::self_weight:
        break;
    }
  }
  take_room(arrows, taken);
  part.shapes = {path_of("load", arrows.lines), path_of("load-head", arrows.heads)};
  part.labels = notes_of(arrows, "note");
  return part;
}

Part support_force_part(const Scene& scene, const View& view, Occupancy& taken) {
  Part part;
  double largest = 0;
  for (const SupportForce& force : scene.support_forces) {
    largest = std::max(largest, std::hypot(force.fx, force.fy));
  }
  Arrows arrows;
  for (const SupportForce& force : scene.support_forces) {
    const double size = std::hypot(force.fx, force.fy);
    const Pixel tip = to_pixel(view, force.at);
    const double length = kPointArrow * std::max(0.45, size / largest);
    const Pixel tail{tip.x - length * force.fx / size, tip.y + length * force.fy / size};
    arrows.add(tail, {tip.x - 3 * force.fx / size, tip.y + 3 * force.fy / size});
    arrows.notes.push_back({tail, with_unit(size, unit_of(scene.input.units, Quantity::force)), size});
  }
  take_room(arrows, taken);
  if (!arrows.lines.empty()) {
    part.shapes = {path_of("support-force", arrows.lines), path_of("support-force-head", arrows.heads)};
    part.labels = notes_of(arrows, "muted");
  }
  return part;
}

}  // namespace snapthrough::api::plot
