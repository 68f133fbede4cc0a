#include "api/plot/drawing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "api/plot/axes.h"

namespace snapthrough::api::plot {
namespace {

/// Undeformed axes, and deformed axes drawn over them.
struct Axes {
  std::vector<Shape> still;
  std::vector<Shape> moved;
};

/// Returns whether a member that carries a force of one sense alone carries none in the drawn state.
bool is_slack(const Scene& scene, const std::string& id) {
  if (scene.input.state == nullptr || scene.input.model == nullptr) {
    return false;
  }
  const std::vector<ModelMember>& members = scene.input.model->members;
  const auto member =
      std::find_if(members.begin(), members.end(), [&](const ModelMember& one) { return one.id == id; });
  const auto state = scene.input.state->members.find(id);
  return member != members.end() && member->one_sided && state != scene.input.state->members.end() &&
         state->second.axial_force.front() == 0;
}

Axes axes_of(const Scene& scene, const View& view, Occupancy& taken) {
  Axes axes;
  const bool only_mode = scene.input.mode != nullptr;
  for (const DrawnMember& member : scene.members) {
    const std::vector<Pixel> here = thinned_points(to_pixels(view, member.x, member.y));
    taken.add_line(here, 40);
    if (scene.mirror) {
      std::vector<Pixel> image = here;
      for (Pixel& point : image) {
        point.x = 2 * to_pixel(view, {*scene.mirror, 0}).x - point.x;
      }
      taken.add_line(image, 20);
    }
    if (scene.input.state != nullptr && !only_mode) {
      const std::vector<Pixel> before = thinned_points(to_pixels(view, member.x0, member.y0));
      taken.add_line(before, 8);
      axes.still.push_back(path("undeformed", before));
    }
    axes.moved.push_back(path(only_mode                    ? "undeformed"
                              : is_slack(scene, member.id) ? "member slack"
                                                           : "member",
                              here));
  }
  return axes;
}

/// Passes values and parabola vertices to `include`, so that a sampled circle of diameter 1 measures 1.
template <class Include>
void include_with_peaks(const std::vector<double>& values, const Include& include) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    include(values[i]);
    if (i == 0 || i + 1 == values.size()) {
      continue;
    }
    const double before = values[i - 1] - values[i];
    const double after = values[i + 1] - values[i];
    if (before * after >= 0 && before + after != 0) {
      include(values[i] - (after - before) * (after - before) / (8 * (after + before)));
    }
  }
}

/// Returns the bounding box of the undeformed axes, including the mirror image.
ModelBox still_box(const Scene& scene) {
  Range across;
  Range up;
  for (const DrawnMember& member : scene.members) {
    include_with_peaks(member.x0, [&](double x) {
      across.include(x);
      across.include(scene.mirror ? 2 * *scene.mirror - x : x);
    });
    include_with_peaks(member.y0, [&](double y) { up.include(y); });
  }
  ModelBox box;
  box.include(across.low, up.low);
  box.include(across.high, up.high);
  return box;
}

Shape dimension_line(Pixel a, Pixel b) {
  const auto tick = [](Pixel p) {
    const Pixel ends[] = {{p.x - 3.5, p.y + 3.5}, {p.x + 3.5, p.y - 3.5}};
    return path_data(ends);
  };
  const Pixel ends[] = {a, b};
  return path_of("dimension", path_data(ends) + tick(a) + tick(b));
}

constexpr double kLeastDimension = 24;  // pixels; a shorter line has no room for its number

double monitor_value(const ModelMonitor& monitor, const Place& place, const MemberState& state, double s) {
  const double u = interpolate(state.s, state.u, s);
  const double v = interpolate(state.s, state.v, s);
  if (monitor.component == "x") {
    return u;
  }
  return monitor.component == "y" ? v : u * place.normal.x + v * place.normal.y;
}

/// Returns a monitor's id with its displacement in the state; without value for a rotation.
std::string monitor_text(const Scene& scene, const ModelMonitor& monitor, const Place& place) {
  if (scene.input.state == nullptr || monitor.component == "rotation") {
    return monitor.id;
  }
  const auto state = scene.input.state->members.find(place.member->id);
  if (state == scene.input.state->members.end()) {
    return monitor.id;
  }
  constexpr double kRounding = 1e-9;  // relative to the extent; less counts as zero
  const double value = monitor_value(monitor, place, state->second, place.s);
  const char* symbol = monitor.component == "x" ? " u = " : monitor.component == "y" ? " v = " : " w = ";
  return monitor.id + symbol +
         with_unit(std::abs(value) > kRounding * scene.extent ? value : 0, scene.input.units.length, 3);
}

/// Adds the line of symmetry and the mirror image of `own` to `shapes`.
void add_mirror_image(const Scene& scene, const View& view, const std::vector<Shape>& own,
                      std::vector<Shape>& shapes) {
  if (!scene.mirror) {
    return;
  }
  const double x = to_pixel(view, {*scene.mirror, 0}).x;
  const double top = to_pixel(view, {0, scene.box.top}).y - 24;
  const double bottom = to_pixel(view, {0, scene.box.bottom}).y + 24;
  shapes.push_back(line("symmetry", {x, top}, {x, bottom}));
  Shape image = group("mirror-image", own);
  image.attributes.emplace_back("transform", "translate(" + coordinate(2 * x) + " 0) scale(-1 1)");
  shapes.push_back(std::move(image));
}

}  // namespace

Part monitor_part(const Scene& scene, const View& view, Occupancy& taken) {
  constexpr std::size_t kMost = 12;  // largest number of labels
  Part part;
  if (scene.input.model == nullptr || scene.input.mode != nullptr) {
    return part;
  }
  for (const ModelMonitor& monitor : scene.input.model->monitors) {
    const std::optional<Place> place = place_of(scene, monitor.at);
    if (!place) {
      continue;
    }
    const Pixel still = to_pixel(view, place->still);
    const Pixel tip = to_pixel(view, place->moved);
    if (std::hypot(tip.x - still.x, tip.y - still.y) > 6) {
      part.shapes.push_back(line("monitor-way", still, tip));
    }
    part.shapes.push_back(circle("monitor", tip, 3.5));
    taken.add_box({tip.x - 4, tip.y - 4, tip.x + 4, tip.y + 4}, 60);
    if (part.labels.size() < kMost) {
      LabelRequest wanted{tip, {{monitor_text(scene, monitor, *place), "", false}}, "monitor-text", 8, 1,
                          true};
      wanted.tolerance = part.labels.empty() ? 400 : 100;
      part.labels.push_back(std::move(wanted));
    }
  }
  return part;
}

Shape dimension_shape(const Scene& scene, const View& view, Size size, Occupancy& taken) {
  const ModelBox box = still_box(scene);
  const ModelBox around = box_with_ground(scene);
  const Pixel low = to_pixel(view, {box.left, box.bottom});
  const Pixel high = to_pixel(view, {box.right, box.top});
  const Pixel outer = to_pixel(view, {around.left, around.bottom});
  const bool springs = scene.input.model != nullptr && !scene.input.model->springs.empty();
  std::vector<Shape> shapes;
  if (high.x - low.x > kLeastDimension) {
    const double y =
        std::min(size.height - 20, outer.y + (springs || !scene.support_forces.empty() ? 60 : 38));
    const std::string text = with_unit(box.right - box.left, scene.input.units.length);
    const double width = text_width(text);
    const double middle = (low.x + high.x) / 2;
    shapes.push_back(dimension_line({low.x, y}, {high.x, y}));
    shapes.push_back(label("dimension-text", {middle, y + 15}, Anchor::middle, text));
    taken.add_box({low.x, y - 4, high.x, y + 4}, 40);
    taken.add_box({middle - width / 2, y + 2, middle + width / 2, y + 18});
  }
  if (low.y - high.y > kLeastDimension) {
    const double x = std::max(20.0, outer.x - 36);
    shapes.push_back(dimension_line({x, low.y}, {x, high.y}));
    shapes.push_back(upright_label("dimension-text", {x - 7, (low.y + high.y) / 2},
                                   with_unit(box.top - box.bottom, scene.input.units.length)));
    taken.add_box({x - 18, high.y, x + 4, low.y}, 40);
  }
  return group("dimensions", std::move(shapes));
}

std::vector<Shape> placed(const std::vector<LabelRequest>& labels, Occupancy& taken) {
  std::vector<Shape> shapes;
  for (const LabelRequest& wanted : labels) {
    if (std::optional<Shape> text = place_label(wanted, taken)) {
      shapes.push_back(std::move(*text));
    }
  }
  return shapes;
}

std::vector<Shape> draw_structure(const Scene& scene, const View& view, Size size, const std::string& caption,
                                  std::vector<Shape> over, Occupancy& taken) {
  taken.add_box({0, 0, size.width, 18});  // reserves the caption's room
  const Shape dimensions = dimension_shape(scene, view, size, taken);
  Axes axes = axes_of(scene, view, taken);
  Part monitors = monitor_part(scene, view, taken);
  Part loads = load_part(scene, view, taken);
  Part forces = support_force_part(scene, view, taken);
  std::vector<Shape> supports = support_shapes(scene, view, taken);
  Part reactions = reaction_part(scene, view, taken);

  std::vector<Shape> own{
      group("reactions", std::move(reactions.shapes)),     group("undeformed-members", std::move(axes.still)),
      group("springs", spring_shapes(scene, view, taken)), group("members", std::move(axes.moved)),
      group("contacts", contact_shapes(scene, view)),      group("modes", std::move(over)),
      group("hinges", hinge_shapes(scene, view)),          group("loads", std::move(loads.shapes))};
  std::vector<Shape> shapes{ground_shape(scene, view, size), dimensions};
  add_mirror_image(scene, view, own, shapes);
  constexpr std::ptrdiff_t kUnderSupports = 3;
  shapes.insert(shapes.end(), std::make_move_iterator(own.begin()),
                std::make_move_iterator(own.begin() + kUnderSupports));
  shapes.push_back(group("supports", std::move(supports)));
  shapes.insert(shapes.end(), std::make_move_iterator(own.begin() + kUnderSupports),
                std::make_move_iterator(own.end()));
  shapes.push_back(group("support-forces", std::move(forces.shapes)));
  shapes.push_back(group("monitors", std::move(monitors.shapes)));
  for (const std::vector<LabelRequest>* labels :
       {&reactions.labels, &monitors.labels, &loads.labels, &forces.labels}) {
    shapes.push_back(group("notes", placed(*labels, taken)));
  }
  shapes.push_back(label("caption", {0, 14}, Anchor::start, fitted(caption, size.width, 12, true)));
  return shapes;
}

}  // namespace snapthrough::api::plot
