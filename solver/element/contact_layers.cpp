#include <algorithm>
#include <cstddef>

#include "solver/element/element_contacts.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {

/// Enters the next contact, on an element, in the lists of layers.
void ElementContacts::add_to_layer(const FoundationContact& contact, int element) {
  if (!contact.has_layer()) {
    layer_of_contact_.emplace_back(-1, 0);
    return;
  }
  const auto same = [&contact](const Layer& layer) { return layer.foundation == contact.foundation(); };
  auto at = std::find_if(layers_.begin(), layers_.end(), same);
  if (at == layers_.end()) at = layers_.insert(at, {contact.foundation(), {}, {}});
  layer_of_contact_.emplace_back(static_cast<int>(at - layers_.begin()), at->contacts.size());
  at->contacts.push_back(layer_of_contact_.size() - 1);
  at->elements.push_back(element);
}

std::vector<LayerCell> ElementContacts::cells_of(const Layer& layer, const double* y) const {
  std::vector<LayerCell> out(layer.contacts.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Element& element = elements_[static_cast<std::size_t>(layer.elements[i])];
    const FoundationContact& contact = contacts_[layer.contacts[i]];
    const DisplacementOnGround u = displacement(contact, element, y);
    out[i].contact = &contact;
    out[i].order = order_;
    out[i].start = u.start;
    out[i].dx = u.x;
    out[i].dy = u.y;
  }
  return out;
}

std::vector<LayerCell> ElementContacts::rates_of(const Layer& layer, const double* along) const {
  std::vector<LayerCell> out = cells_of(layer, along);
  for (LayerCell& cell : out) cell.above = cell.contact->law().gap;
  return out;
}

/// A layer that is pressed nowhere acts where its supports that touch without pressure are known to act.
LayerParts ElementContacts::acting_parts(const Layer& layer, const std::vector<LayerCell>& cells) const {
  const auto is_known = [&](std::size_t contact) { return touches_[contact] != Touch::none; };
  const bool touches = std::any_of(layer.contacts.begin(), layer.contacts.end(), is_known) &&
                       !is_pressed(cells, Rounding::touching);
  if (!touches) return touching_parts(cells);
  LayerParts out(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (touches_[layer.contacts[i]] == Touch::acts)
      out[i].push_back({cells[i].contact->range()[0], cells[i].contact->range()[1]});
  return out;
}

/// Parts on which contacts act at y: one list for each contact, empty without a shear layer; no lists in a
/// mesh without layers.
LayerParts ElementContacts::parts_on_layers(const double* y) const {
  LayerParts out(layers_.empty() ? 0 : contacts_.size());
  for (const Layer& layer : layers_) {
    LayerParts parts = acting_parts(layer, cells_of(layer, y));
    for (std::size_t i = 0; i < parts.size(); ++i) out[layer.contacts[i]] = std::move(parts[i]);
  }
  return out;
}

/// Appends the zones on layers to those of the other foundations.
void ElementContacts::add_moving_layers(const Eigen::VectorXd& y, const Eigen::VectorXd& rate,
                                        MovingZones& out) const {
  if (layers_.empty()) return;
  std::vector<double> starts{0.0};
  for (const Element& element : elements_) starts.push_back(starts.back() + element.length);
  for (const Layer& layer : layers_) {
    const auto cells = cells_of(layer, y.data());
    const auto rates = rates_of(layer, rate.data());
    const std::vector<LayerEdge> edges = edges_of(cells, acting_parts(layer, cells));
    const auto index = static_cast<std::size_t>(layer.foundation);
    if (out.size() <= index) out.resize(index + 1);
    const auto place = [&](const LayerEdge& edge) {
      const auto element = static_cast<std::size_t>(layer.elements[edge.cell]);
      return starts[element] + edge.xi * elements_[element].length;
    };
    for (std::size_t i = 0; i < edges.size(); i += 2)
      out[index].push_back({place(edges[i]), place(edges[i + 1]), edge_rate(cells, rates, edges, i),
                            edge_rate(cells, rates, edges, i + 1)});
  }
}

void ElementContacts::freeze_layers(const Eigen::VectorXd& y, double tolerance, FrozenContact& out) const {
  for (const Layer& layer : layers_) {
    std::vector<LayerCell> cells = cells_of(layer, y.data());
    for (LayerCell& cell : cells) cell.above = tolerance;
    LayerParts parts = touching_parts(cells);
    for (std::size_t i = 0; i < parts.size(); ++i) out.contacts[layer.contacts[i]] = std::move(parts[i]);
  }
}

/// Removes the marks of layers that are pressed somewhere: their surface leaves a member that does not enter
/// the medium.
void ElementContacts::unmark_pressed_layers(const Eigen::VectorXd& y, const TouchingDistance& near,
                                            TouchingMarks& out) const {
  for (const Layer& layer : layers_) {
    const double distance = near.of(contacts_[layer.contacts.front()].law().stiffness);
    if (!is_pressed(cells_of(layer, y.data()), distance)) continue;
    for (const std::size_t contact : layer.contacts) out.contacts[contact] = 0;
  }
}

/// Marked layers act where a surface without pressure follows the motion `mode`.
void ElementContacts::set_touching_layers(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                                          FrozenContact& out) const {
  for (const Layer& layer : layers_) {
    std::vector<LayerCell> cells;
    std::vector<std::size_t> contacts;
    const std::vector<LayerCell> all = rates_of(layer, mode.data());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (marks.contacts[layer.contacts[i]] == 0) continue;
      contacts.push_back(layer.contacts[i]);
      cells.push_back(all[i]);
    }
    if (cells.empty()) continue;
    LayerParts parts = touching_parts(cells, snapthrough::layer_of(all));
    for (std::size_t i = 0; i < parts.size(); ++i) out.contacts[contacts[i]] = std::move(parts[i]);
  }
}

}  // namespace snapthrough
