#include <algorithm>

#include "api/plot/drawing.h"
#include "api/plot/figures.h"
#include "api/plot/plot_error.h"

namespace snapthrough::api::plot {
namespace {

std::string counted(std::size_t count, const std::string& name) {
  return std::to_string(count) + " " + name + (count == 1 ? "" : "s");
}

}  // namespace

Figure model_figure(const ResultInput& input, const PlotRequest& request, Size size) {
  const Model& model = *input.model;
  if (model.members.empty()) {
    throw PlotError("", "the model has no member to draw");
  }
  const Scene scene = make_scene({&model, nullptr, nullptr, input.units, 1, std::nullopt});
  const Size used = request.height ? size : needed_size(scene, size);
  Occupancy taken(used);
  Figure figure;
  figure.height = used.height;
  figure.title =
      std::string("Undeformed structure") + (scene.mirror ? ", half mirrored" : "") +
      (std::ranges::any_of(model.members, &ModelMember::hangs) ? ", cables as straight lines" : "");
  figure.description = counted(model.nodes.size(), "node") + ", " + counted(model.members.size(), "member") +
                       ", " + counted(model.supports.size(), "support") + ", " +
                       counted(model.loads.size(), "load") + ".";
  figure.shapes = draw_structure(scene, scene_view(scene, used), used, figure.title, {}, taken);
  return figure;
}

}  // namespace snapthrough::api::plot
