#include "solver/report/contact.h"

#include <cstddef>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/layer_state.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

/// Contact intervals of one part of a foundation, in the element's coordinate.
void local_intervals(const Structure& structure, const FoundationPart& part, const Eigen::VectorXd& y,
                     double depth, std::vector<FoundationContact::Interval>& out) {
  out.assign(1, {part.range[0], part.range[1]});
  if (!part.contact) return;
  const FoundationLaw& law = structure.foundation_laws[static_cast<std::size_t>(part.foundation)];
  const ElementReader reader(structure, y, part.element, law);
  part.contact->contact_intervals({reader.start()[0], reader.start()[1]}, reader.gradient(0),
                                  reader.gradient(1), out, depth);
}

/// Contact zones of a foundation with a shear layer. A member may touch at one point: a zone without length.
std::vector<std::array<double, 2>> layer_intervals(const Structure& structure, const Eigen::VectorXd& y,
                                                   int foundation, double depth) {
  const LayerState layer = layer_state(structure, y, foundation, depth);
  const auto arc = [&](const LayerEdge& edge) {
    return structure.scales.length * layer.cells[edge.cell].arc(edge.xi);
  };
  std::vector<std::array<double, 2>> out;
  for (std::size_t i = 0; i < layer.edges.size(); i += 2)
    out.push_back({arc(layer.edges[i]), arc(layer.edges[i + 1])});
  return out;
}

}  // namespace

std::vector<std::array<double, 2>> contact_intervals(const Structure& structure, const Eigen::VectorXd& y,
                                                     int foundation, double depth) {
  const ResolvedModel& model = *structure.model;
  if (initial_stiffness(model.foundations[foundation]) == 0.0) return {};
  if (structure.foundation_laws[static_cast<std::size_t>(foundation)].has_layer())
    return layer_intervals(structure, y, foundation, depth);
  const int member = model.foundations[foundation].member;
  const double length = structure.axes[member]->length();
  std::vector<std::array<double, 2>> joined;
  std::vector<FoundationContact::Interval> local;
  for (const int index : structure.parts_of_foundation[static_cast<std::size_t>(foundation)]) {
    const FoundationPart& part = structure.foundation_parts[static_cast<std::size_t>(index)];
    local_intervals(structure, part, y, depth, local);
    const MeshElement& cell = structure.mesh.elements[part.element];
    for (const auto& interval : local) {
      if (interval.to - interval.from <= kOnePlace) continue;
      const double from = length * (cell.from + interval.from * (cell.to - cell.from));
      const double to = length * (cell.from + interval.to * (cell.to - cell.from));
      if (!joined.empty() && from - joined.back()[1] <= kOnePlace * length)
        joined.back()[1] = to;
      else
        joined.push_back({from, to});
    }
  }
  return joined;
}

ContactZones::ContactZones(const Structure& structure) : structure_(structure) {
  const ResolvedModel& model = *structure.model;
  for (std::size_t i = 0; i < model.foundations.size(); ++i) {
    if (!is_one_sided(model.foundations[i])) continue;
    foundations_.push_back(static_cast<int>(i));
    ids_.push_back(model.foundations[i].id);
  }
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    if (!is_one_sided(model.springs[i])) continue;
    springs_.push_back(i);
    ids_.push_back(model.springs[i].id);
  }
}

void ContactZones::count(const Eigen::VectorXd& y, std::vector<int>& zones) const {
  zones.clear();
  for (const int foundation : foundations_)
    zones.push_back(
        static_cast<int>(contact_intervals(structure_, y, foundation, Rounding::last_places).size()));
  for (const std::size_t i : springs_) {
    const double depth = reading_of(structure_, i, y).depth;
    zones.push_back(depth > Rounding::last_places ? 1 : 0);
  }
}

}  // namespace snapthrough
