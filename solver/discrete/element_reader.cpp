#include "solver/discrete/element_reader.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {

ElementReader::ElementReader(const Structure& structure, const Eigen::VectorXd& y, int element)
    : p_(structure.mesh.order),
      h_(length_of_element(structure, element)),
      rule_(&CollocationRule::of(structure.mesh.order)) {
  const ElementDofs& dofs = structure.dofs[element];
  for (int c = 0; c < 3; ++c) {
    ua_[c] = y[dofs.a[c]];
    for (int q = 0; q < p_; ++q) dv_[c][q] = h_ * y[dofs.v + c * p_ + q];
  }
}

ElementReader::ElementReader(const Structure& structure, const Eigen::VectorXd& y, int element,
                             const FoundationLaw& foundation)
    : ElementReader(structure, y, element) {
  if (foundation.rotational) {
    ua_ = {ua_[2], 0.0, ua_[2]};
    dv_[0] = dv_[2];
    dv_[1] = {};
  }
  const MeshElement& cell = structure.mesh.elements[static_cast<std::size_t>(element)];
  foundation.ground_under(cell.from, cell.to)
      .subtract_from(y.data(), ua_, std::span(dv_[0]).first(p_), std::span(dv_[1]).first(p_));
}

std::array<double, 3> ElementReader::displacement(double xi) const {
  std::array<double, kMaxOrder> a{};
  rule_->integrals_at(xi, std::span(a).first(p_));
  std::array<double, 3> u = ua_;
  for (int c = 0; c < 3; ++c)
    for (int q = 0; q < p_; ++q) u[c] += a[q] * dv_[c][q];
  return u;
}

std::array<double, 3> ElementReader::derivative(double xi) const {
  std::array<double, kMaxOrder> l{};
  rule_->values_at(xi, std::span(l).first(p_));
  std::array<double, 3> du{};
  for (int c = 0; c < 3; ++c)
    for (int q = 0; q < p_; ++q) du[c] += l[q] * dv_[c][q] / h_;
  return du;
}

}  // namespace snapthrough
