#include <cmath>

#include "api/plot/axes.h"
#include "api/plot/drawing.h"
#include "api/plot/figures.h"
#include "api/plot/plot_error.h"
#include "api/plot/sections.h"

namespace snapthrough::api::plot {
namespace {

struct ChosenMode {
  Mode mode;
  double load_factor = 0;
  std::optional<std::size_t> state;  ///< index of the critical point's state
  std::string name;
};

ChosenMode read_buckling_mode(const Field& buckling, std::size_t index) {
  const Field modes = buckling.at("modes");
  if (index >= modes.size()) {
    throw PlotError("/buckling/modes/" + std::to_string(index),
                    modes.size() == 0 ? "the result has no modes"
                                      : "the result has modes 0 to " + std::to_string(modes.size() - 1));
  }
  const std::vector<double> loads = buckling.at("load_factors").numbers(modes.size());
  return {read_mode(modes.item(index)), loads[index], std::nullopt,
          "Buckling mode " + std::to_string(index + 1)};
}

/// Reads a motion of a vibration analysis; motions of the load factors count one after another.
ChosenMode read_motion(const Field& vibrations, std::size_t index) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < vibrations.size(); ++i) {
    const Field vibration = vibrations.item(i);
    const Field modes = vibration.at("modes");
    if (index < first + modes.size()) {
      const std::size_t own = index - first;
      return {read_mode(modes.item(own)), vibration.at("load_factor").number(), std::nullopt,
              "Natural motion " + std::to_string(own + 1)};
    }
    first += modes.size();
  }
  throw PlotError("/vibrations", "the result has " + std::to_string(first) + " natural motions");
}

ChosenMode read_critical_mode(const Field& result, const std::optional<std::size_t>& asked) {
  const std::vector<CriticalPoint> points = read_critical_points(result);
  for (std::size_t i = asked.value_or(0); i < points.size(); ++i) {
    if (const std::optional<Field> mode = result.at("critical_points").item(i).find("mode")) {
      return {read_mode(*mode), points[i].load_factor, points[i].state,
              std::string("Mode of the ") + mark_text(points[i].mark)};
    }
    if (asked) {
      throw PlotError("/critical_points/" + std::to_string(i) + "/mode", "the critical point has no mode");
    }
  }
  if (asked) {
    throw PlotError("/critical_points/" + std::to_string(*asked),
                    "the result has " + std::to_string(points.size()) + " critical points");
  }
  throw PlotError("/critical_points", "the result has no buckling mode and no critical point with a mode");
}

ChosenMode read_chosen(const Field& result, const std::optional<std::size_t>& asked) {
  if (const std::optional<Field> buckling = result.find("buckling")) {
    return read_buckling_mode(*buckling, asked.value_or(0));
  }
  if (const std::optional<Field> vibrations = result.find("vibrations")) {
    return read_motion(*vibrations, asked.value_or(0));
  }
  return read_critical_mode(result, asked);
}

/// Returns the axes displaced by the mode times `amplitude`.
std::vector<Shape> mode_shapes(const Scene& scene, const View& view, const Mode& mode, double amplitude,
                               Occupancy& taken) {
  std::vector<Shape> shapes;
  for (const auto& [id, shape] : mode) {
    const DrawnMember& member = *scene.member(id);
    std::vector<Pixel> points;
    for (std::size_t i = 0; i < shape.s.size(); ++i) {
      points.push_back(
          to_pixel(view, {interpolate(member.s, member.x0, shape.s[i]) + amplitude * shape.u[i],
                          interpolate(member.s, member.y0, shape.s[i]) + amplitude * shape.v[i]}));
    }
    points = thinned_points(points);
    taken.add_line(points, 30);
    shapes.push_back(path("mode", points));
  }
  return shapes;
}

/// Draws the displacements of a mode over the members' arc length, when the axes are unknown.
Figure mode_panels(const ChosenMode& chosen, const Units& units, const std::string& caption, Size size) {
  std::vector<std::string> ids;
  for (const auto& [id, shape] : chosen.mode) {
    ids.push_back(id);
  }
  Sections sections;
  sections.units = units;
  sections.panels = {{"displacement u, to the right", "section-N", "", {}, kRoundingOfSections},
                     {"displacement v, up", "section-Q", "", {}, kRoundingOfSections}};
  for (const std::string& id : naturally_sorted(std::move(ids))) {
    const ModeShape& shape = chosen.mode.at(id);
    sections.members.push_back({id, shape.s.back()});
    sections.panels[0].lines.push_back({shape.s, shape.u});
    sections.panels[1].lines.push_back({shape.s, shape.v});
  }
  return draw_sections(sections, caption, size);
}

}  // namespace

Figure mode_figure(const ResultInput& input, const PlotRequest& request, Size size) {
  constexpr double kShare = 0.1;  // amplitude relative to the extent
  const ChosenMode chosen = read_chosen(input.result, request.mode);
  const std::string caption =
      chosen.name + " at load factor " + format_number(chosen.load_factor, 5) + ", size without meaning";
  std::optional<State> state;
  if (chosen.state) {
    state = read_state(input.result, *chosen.state);
  }
  if (!input.model && !state) {
    return mode_panels(chosen, input.units, caption, size);
  }
  // a mode is drawn on the undeformed structure: the state gives axes only
  SceneInput scene_input{
      input.model ? &*input.model : nullptr, nullptr, &chosen.mode, input.units, 1, chosen.load_factor};
  if (state) {
    for (auto& [id, member] : state->members) {
      member.x = member.x0;
      member.y = member.y0;
    }
    state->foundations.clear();
    state->supports.clear();
    state->springs.clear();
    scene_input.state = &*state;
  }
  Scene scene = make_scene(scene_input);
  const double amplitude = kShare * scene.extent * request.magnify.value_or(1);
  for (const auto& [id, shape] : chosen.mode) {
    const DrawnMember& member = *scene.member(id);
    for (std::size_t i = 0; i < shape.s.size(); ++i) {
      scene.box.include(interpolate(member.s, member.x0, shape.s[i]) + amplitude * shape.u[i],
                        interpolate(member.s, member.y0, shape.s[i]) + amplitude * shape.v[i]);
    }
  }
  const Size used = request.height ? size : needed_size(scene, size);
  const View view = scene_view(scene, used);
  Occupancy taken(used);
  Figure figure;
  figure.height = used.height;
  figure.title = caption + (scene.mirror ? ", half mirrored" : "");
  figure.description = chosen.name + " at load factor " + format_number(chosen.load_factor, 6) + ".";
  figure.shapes = draw_structure(scene, view, used, figure.title,
                                 mode_shapes(scene, view, chosen.mode, amplitude, taken), taken);
  return figure;
}

}  // namespace snapthrough::api::plot
