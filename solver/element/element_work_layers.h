#pragma once
/// @file
/// One-sided foundations with a shear layer in ElementWorkOf. Included by element_work.h only.

namespace snapthrough {

/// Parts on which the contacts of a layer act in the regime of the current call. They are searched for once
/// for each y.
template <int P>
LayerParts ElementWorkOf<P>::parts_of_layer(const ElementContacts::Layer& layer,
                                            const std::vector<LayerCell>& cells) {
  LayerParts out(cells.size());
  const auto copy_from = [&](const std::vector<std::vector<ElementPart>>& lists) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = lists[layer.contacts[i]];
  };
  if (regime_.bilateral()) {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i].push_back({cells[i].contact->range()[0], cells[i].contact->range()[1]});
    return out;
  }
  if (regime_.is_frozen()) {
    copy_from(regime_.frozen->contacts);
    return out;
  }
  if (parts_known_[layer.contacts.front()] == 0) {
    out = data_.contacts.acting_parts(layer, cells);
    for (std::size_t i = 0; i < out.size(); ++i) {
      parts_[layer.contacts[i]] = out[i];
      parts_known_[layer.contacts[i]] = 1;
    }
  }
  copy_from(parts_);
  return out;
}

/// Finds contact and couplings of all layers at y. @pre find_kinematics() was called at y
template <int P>
void ElementWorkOf<P>::find_layers(const double* y) {
  couplings_.clear();
  layers_.resize(data_.contacts.layers().size());
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    LayerContact& here = layers_[l];
    here.cells = data_.contacts.cells_of(data_.contacts.layers()[l], y);
    here.parts = parts_of_layer(data_.contacts.layers()[l], here.cells);
    here.edges = edges_of(here.cells, here.parts);
    for (const LayerEdge& edge : here.edges)
      if (edge.other >= 0 && edge.begins) couplings_.push_back(coupling_of(l, edge));
  }
}

/// Adds the weights of a functional (the penetration at a place of an element, or its slope), times a factor,
/// to the row of a coupling.
template <int P>
void ElementWorkOf<P>::add_row(const Functional& f, int element, double factor, Coupling& out) const {
  const ElementDofs& dofs = dofs_[element];
  for (int c = 0; c < 2; ++c) {
    out.row.emplace_back(dofs.a[c], factor * f.a[c]);
    for (int q = 0; q < P; ++q) out.row.emplace_back(dofs.v + c * P + q, factor * f.v[c][q]);
  }
}

/// Functional of the penetration at an end of contact, with the resistance of the ground beyond it.
template <int P>
auto ElementWorkOf<P>::edge_functional(std::size_t layer, const LayerEdge& edge) const -> Functional {
  const FoundationContact& contact = *layers_[layer].cells[edge.cell].contact;
  Functional f = data_.functional_at(contact, contact.length(), edge.xi, nullptr);
  f.law.stiffness = edge.stiffness;
  return f;
}

/// Resistance of the ground between two zones to the difference of the penetrations at their ends.
template <int P>
Coupling ElementWorkOf<P>::coupling_of(std::size_t layer, const LayerEdge& edge) const {
  const LayerEdge& other = layers_[layer].edges[static_cast<std::size_t>(edge.other)];
  const std::vector<int>& elements = data_.contacts.layers()[layer].elements;
  Coupling out;
  add_row(edge_functional(layer, edge), elements[edge.cell], 1.0, out);
  add_row(edge_functional(layer, other), elements[other.cell], -1.0, out);
  out.compliance = edge.compliance / regime_.softness;
  return out;
}

/// Appends the shear layer of a contact to acting_: its slopes at Gauss points of the parts in contact, and
/// the penetrations at the ends of zones.
/// @param share factor on the stiffness
template <int P>
void ElementWorkOf<P>::add_layer(std::size_t index, const Shape& shape, double share) {
  const auto [number, cell] = data_.contacts.layer_of(index);
  const LayerContact& layer = layers_[static_cast<std::size_t>(number)];
  const Quadrature& gauss = data_.contact_quadrature;
  for (const ElementPart& part : layer.parts[cell]) {
    const double width = part.to - part.from;
    for (std::size_t i = 0; width > 0.0 && i < gauss.points.size(); ++i) {
      acting_.push_back(
          data_.slope_functional(contacts_[index], shape.h, part.from + width * gauss.points[i]));
      acting_.back().law.scale(share * width * gauss.weights[i]);
    }
  }
  for (const LayerEdge& edge : layer.edges) {
    if (edge.cell != cell || edge.stiffness == 0.0) continue;
    acting_.push_back(edge_functional(static_cast<std::size_t>(number), edge));
    acting_.back().law.scale(share);
    if (regime_.bilateral()) acting_.back().law.gap = 0.0;
  }
}

template <int P>
void ElementWorkOf<P>::add_coupling_forces(const double* y, double* residual) {
  for (const Coupling& coupling : couplings_) {
    coupling.push(coupling.value(y) / coupling.compliance, residual);
    double size = 0.0;
    for (const auto& [unknown, weight] : coupling.row) size += std::abs(weight * y[unknown]);
    support_rounding_ =
        std::max(support_rounding_, size / coupling.compliance * std::numeric_limits<double>::epsilon());
  }
}

/// Adds the change of the tangent by moving ends of contact on layers, times directions. With c the surface
/// beyond an end that follows the penetration v, the tangent changes by G (v' - c')^2 for each unit of arc
/// length by which a zone's end advances, and by the opposite for its start.
template <int P>
void ElementWorkOf<P>::add_layer_changes(const double* along,
                                         const Eigen::Ref<const Eigen::MatrixXd>& directions,
                                         Eigen::MatrixXd& out) const {
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    const auto rates = data_.contacts.rates_of(data_.contacts.layers()[l], along);
    const auto& [cells, parts, edges] = layers_[l];
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const LayerEdge& edge = edges[i];
      const double moved = edge_rate(cells, rates, edges, i);
      if (moved == 0.0) continue;
      const FoundationContact& contact = *cells[edge.cell].contact;
      const double shear = contact.shear();
      const double sense = edge.begins ? 1.0 : -1.0;
      const int element = data_.contacts.layers()[l].elements[edge.cell];
      Coupling row;
      add_row(data_.slope_functional(contact, contact.length(), edge.xi), element, 1.0 / contact.length(),
              row);
      add_row(edge_functional(l, edge), element, -sense * edge.stiffness / shear, row);
      if (edge.other >= 0) {
        for (const auto& [unknown, weight] : coupling_of(l, edge).row)
          row.row.emplace_back(unknown, -sense / (shear * edge.compliance) * weight);
      }
      const double stiffness = -sense * regime_.softness * shear * moved;
      for (Eigen::Index k = 0; k < directions.cols(); ++k)
        row.push(stiffness * row.value(directions.col(k).data()), out.col(k).data());
    }
  }
}

}  // namespace snapthrough
