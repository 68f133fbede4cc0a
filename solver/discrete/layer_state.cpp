#include "solver/discrete/layer_state.h"

#include <algorithm>
#include <cstddef>

#include "solver/discrete/element_reader.h"

namespace snapthrough {

std::vector<ElementPart> LayerState::on_element(int element) const {
  const auto at = std::find(elements.begin(), elements.end(), element);
  return at == elements.end() ? std::vector<ElementPart>{}
                              : parts[static_cast<std::size_t>(at - elements.begin())];
}

LayerState layer_state(const Structure& structure, const Eigen::VectorXd& y, int foundation, double depth) {
  LayerState out;
  for (const int index : structure.parts_of_foundation[static_cast<std::size_t>(foundation)]) {
    const FoundationPart& part = structure.foundation_parts[static_cast<std::size_t>(index)];
    const ElementReader reader(structure, y, part.element);
    LayerCell& cell = out.cells.emplace_back();
    cell.contact = &*part.contact;
    cell.order = structure.mesh.order;
    cell.start = {reader.start()[0], reader.start()[1]};
    std::copy(reader.gradient(0).begin(), reader.gradient(0).end(), cell.dx.begin());
    std::copy(reader.gradient(1).begin(), reader.gradient(1).end(), cell.dy.begin());
    cell.above = -depth;
    out.elements.push_back(part.element);
  }
  out.parts = touching_parts(out.cells);
  out.edges = edges_of(out.cells, out.parts);
  return out;
}

std::vector<LayerState> layer_states(const Structure& structure, const Eigen::VectorXd& y) {
  std::vector<LayerState> out(structure.foundation_laws.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    if (structure.foundation_laws[i].has_layer()) out[i] = layer_state(structure, y, static_cast<int>(i));
  return out;
}

}  // namespace snapthrough
