#include <cmath>

#include "api/plot/drawing.h"
#include "api/plot/figures.h"

namespace snapthrough::api::plot {
namespace {

/// Returns the requested factor of displacements, or suggested_factor().
double factor_of(const PlotRequest& request, const SceneInput& input) {
  return request.magnify ? *request.magnify : suggested_factor(make_scene(input));
}

/// Returns the type of the critical point that has the state, in brackets; "" when none has it.
std::string critical_words(const Field& result, std::size_t state) {
  for (const CriticalPoint& point : read_critical_points(result)) {
    if (point.state == state) {
      return std::string(" (") + mark_text(point.mark) + ")";
    }
  }
  return "";
}

std::string caption_of(const Scene& scene, const std::string& critical) {
  const double factor = scene.input.factor;
  return "Deformed shape at load factor " + format_number(scene.load_factor(), 5) + critical +
         (factor == 1 ? ", true scale" : ", displacements \u00d7 " + format_number(factor, 3)) +
         (scene.mirror ? ", half mirrored" : "");
}

std::string description_of(const State& state, std::size_t index) {
  std::string text =
      "State " + std::to_string(index) + " at load factor " + format_number(state.load_factor, 6) + ".";
  for (const auto& [id, foundation] : state.foundations) {
    double length = 0;
    for (const auto& [from, to] : foundation.contact) {
      length += to - from;
    }
    text += " Foundation " + id + ": " + std::to_string(foundation.contact.size()) +
            " contact regions, length " + format_number(length) + ".";
  }
  return text;
}

}  // namespace

Figure shape_figure(const ResultInput& input, const PlotRequest& request, Size size) {
  const std::size_t index = chosen_state(input.result, request.state);
  const State state = read_state(input.result, index);
  SceneInput scene_input{
      input.model ? &*input.model : nullptr, &state, nullptr, input.units, 1, state.load_factor};
  scene_input.factor = factor_of(request, scene_input);
  const Scene scene = make_scene(scene_input);
  const Size used = request.height ? size : needed_size(scene, size);
  Occupancy taken(used);
  Figure figure;
  figure.height = used.height;
  figure.title = caption_of(scene, critical_words(input.result, index));
  figure.description = description_of(state, index);
  figure.shapes = draw_structure(scene, scene_view(scene, used), used, figure.title, {}, taken);
  return figure;
}

}  // namespace snapthrough::api::plot
