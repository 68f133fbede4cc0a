#pragma once
/// @file
/// One-sided foundations with a shear layer in ElementData and ElementSetOf. Included by element_data.h only.

#include <algorithm>
#include <cstddef>

namespace snapthrough {

template <int P>
void ElementData<P>::add_to_layer(const FoundationContact& contact, int element) {
  if (!contact.has_layer()) {
    layer_of_contact.emplace_back(-1, 0);
    return;
  }
  const auto same = [&contact](const Layer& layer) { return layer.foundation == contact.foundation(); };
  auto at = std::find_if(layers.begin(), layers.end(), same);
  if (at == layers.end()) at = layers.insert(at, {contact.foundation(), {}, {}});
  layer_of_contact.emplace_back(static_cast<int>(at - layers.begin()), at->contacts.size());
  at->contacts.push_back(layer_of_contact.size() - 1);
  at->elements.push_back(element);
}

template <int P>
std::vector<LayerCell> ElementData<P>::cells_of(const Layer& layer, const double* y) const {
  std::vector<LayerCell> out(layer.contacts.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto element = static_cast<std::size_t>(layer.elements[i]);
    const FoundationContact& contact = contacts[layer.contacts[i]];
    const ContactDisplacement u = displacement_of(contact, shapes[element], dofs[element], y);
    out[i].contact = &contact;
    out[i].order = P;
    out[i].start = u.start;
    std::copy(u.dx.begin(), u.dx.end(), out[i].dx.begin());
    std::copy(u.dy.begin(), u.dy.end(), out[i].dy.begin());
  }
  return out;
}

/// A layer that is pressed nowhere acts where its supports that touch without pressure are known to act.
template <int P>
LayerParts ElementData<P>::acting_parts(const Layer& layer, const std::vector<LayerCell>& cells) const {
  const auto is_known = [&](std::size_t contact) { return contact_touch[contact] != Touch::none; };
  const bool touches = std::any_of(layer.contacts.begin(), layer.contacts.end(), is_known) &&
                       !is_pressed(cells, Rounding::touching);
  if (!touches) return touching_parts(cells);
  LayerParts out(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (contact_touch[layer.contacts[i]] == Touch::acts)
      out[i].push_back({cells[i].contact->range()[0], cells[i].contact->range()[1]});
  return out;
}

template <int P>
LayerParts ElementData<P>::parts_on_layers(const double* y) const {
  LayerParts out(layers.empty() ? 0 : contacts.size());
  for (const Layer& layer : layers) {
    LayerParts parts = acting_parts(layer, cells_of(layer, y));
    for (std::size_t i = 0; i < parts.size(); ++i) out[layer.contacts[i]] = std::move(parts[i]);
  }
  return out;
}

template <int P>
auto ElementData<P>::slope_functional(const FoundationContact& contact, double h, double xi) const
    -> Functional {
  const auto d = contact.direction_at(xi);
  const auto rate = contact.direction_rate(xi);
  Gauss integrals;
  Gauss values;
  rule->integrals_at(xi, integrals);
  rule->values_at(xi, values);
  Functional f = penetration(rate, h, integrals);
  for (int c = 0; c < 2; ++c)
    for (int q = 0; q < P; ++q) f.v[c][q] += h * values[q] * d[c];
  f.law.stiffness = contact.shear() / h;
  return f;
}

template <int P>
std::vector<LayerCell> ElementData<P>::rates_of(const Layer& layer, const double* along) const {
  std::vector<LayerCell> out = cells_of(layer, along);
  for (LayerCell& cell : out) cell.above = cell.contact->law().gap;
  return out;
}

/// Appends the zones on layers to those of the other foundations.
template <int P>
void ElementSetOf<P>::add_moving_layers(const Eigen::VectorXd& y, const Eigen::VectorXd& rate,
                                        MovingZones& out) const {
  if (data_.layers.empty()) return;
  std::vector<double> starts{0.0};
  for (const auto& shape : data_.shapes) starts.push_back(starts.back() + shape.h);
  for (const auto& layer : data_.layers) {
    const auto cells = data_.cells_of(layer, y.data());
    const auto rates = data_.rates_of(layer, rate.data());
    const std::vector<LayerEdge> edges = edges_of(cells, data_.acting_parts(layer, cells));
    const auto index = static_cast<std::size_t>(layer.foundation);
    if (out.size() <= index) out.resize(index + 1);
    const auto place = [&](const LayerEdge& edge) {
      const auto element = static_cast<std::size_t>(layer.elements[edge.cell]);
      return starts[element] + edge.xi * data_.shapes[element].h;
    };
    for (std::size_t i = 0; i < edges.size(); i += 2)
      out[index].push_back({place(edges[i]), place(edges[i + 1]), edge_rate(cells, rates, edges, i),
                            edge_rate(cells, rates, edges, i + 1)});
  }
}

template <int P>
void ElementSetOf<P>::freeze_layers(const Eigen::VectorXd& y, double tolerance, FrozenContact& out) const {
  for (const auto& layer : data_.layers) {
    std::vector<LayerCell> cells = data_.cells_of(layer, y.data());
    for (LayerCell& cell : cells) cell.above = tolerance;
    LayerParts parts = touching_parts(cells);
    for (std::size_t i = 0; i < parts.size(); ++i) out.contacts[layer.contacts[i]] = std::move(parts[i]);
  }
}

/// Removes the marks of layers that are pressed somewhere: their surface leaves a member that does not enter
/// the medium.
template <int P>
void ElementSetOf<P>::unmark_pressed_layers(const Eigen::VectorXd& y, const TouchingDistance& near,
                                            TouchingMarks& out) const {
  for (const auto& layer : data_.layers) {
    const double distance = near.of(data_.contacts[layer.contacts.front()].law().stiffness);
    if (!is_pressed(data_.cells_of(layer, y.data()), distance)) continue;
    for (const std::size_t contact : layer.contacts) out.contacts[contact] = 0;
  }
}

/// Marked layers act where a surface without pressure follows the motion `mode`.
template <int P>
void ElementSetOf<P>::set_touching_layers(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                                          FrozenContact& out) const {
  for (const auto& layer : data_.layers) {
    std::vector<LayerCell> cells;
    std::vector<std::size_t> contacts;
    const std::vector<LayerCell> all = data_.rates_of(layer, mode.data());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (marks.contacts[layer.contacts[i]] == 0) continue;
      contacts.push_back(layer.contacts[i]);
      cells.push_back(all[i]);
    }
    if (cells.empty()) continue;
    LayerParts parts = touching_parts(cells, layer_of(all));
    for (std::size_t i = 0; i < parts.size(); ++i) out.contacts[contacts[i]] = std::move(parts[i]);
  }
}

}  // namespace snapthrough
