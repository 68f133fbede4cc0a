#include "solver/discrete/transfer.h"

#include <array>
#include <span>

#include "solver/discrete/element_reader.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {
namespace {

/// Sum of the first `order` weights l times the values from y[first] on.
double sum_of(const std::array<double, kMaxOrder>& l, int order, const Eigen::VectorXd& y, int first) {
  double sum = 0.0;
  for (int q = 0; q < order; ++q) sum += l[q] * y[first + q];
  return sum;
}

/// Transfers the state to one element of `to` from the element of `from` that contains it.
void transfer_element(const Structure& from, const Eigen::VectorXd& y, const Structure& to, int element,
                      Eigen::VectorXd& out) {
  const MeshElement& cell = to.mesh.elements[element];
  const ElementDofs& dofs = to.dofs[element];
  const CollocationRule& target = CollocationRule::of(to.mesh.order);
  const CollocationRule& source = CollocationRule::of(from.mesh.order);
  const int p = to.mesh.order;
  const int source_order = from.mesh.order;
  for (int q = 0; q < p; ++q) {
    const MeshPlace at =
        place_of(from.mesh, cell.member, cell.from + target.point(q) * (cell.to - cell.from));
    const ElementDofs& old = from.dofs[at.element];
    std::array<double, kMaxOrder> l{};
    source.values_at(at.xi, std::span(l).first(source_order));
    for (int c = 0; c < 3; ++c) {
      out[dofs.v + c * p + q] = sum_of(l, source_order, y, old.v + c * source_order);
      out[dofs.s + c * p + q] = sum_of(l, source_order, y, old.s + c * source_order);
    }
  }
  // the element that ends at this place or contains it
  MeshPlace end = place_of(from.mesh, cell.member, cell.to);
  if (end.xi == 0.0 && end.element > from.mesh.first[cell.member]) end = {end.element - 1, 1.0};
  const std::array<double, 3> u = ElementReader(from, y, end.element).displacement(end.xi);
  // the multiplier enters the equations linearly, so that any value is a valid starting point
  for (int c = 0; c < 3; ++c) out[dofs.m + c] = y[from.dofs[end.element].m + c];
  const bool inside = dofs.b[0] >= 3 * to.nodes + to.releases;
  for (int c = 0; inside && c < 3; ++c) out[dofs.b[c]] = u[c];
}

}  // namespace

Eigen::VectorXd transfer(const Structure& from, const Eigen::VectorXd& y, const Structure& to) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(to.size);
  const Eigen::Index shared = 3 * from.nodes + from.releases;
  out.head(shared) = y.head(shared);
  const int elements = static_cast<int>(to.mesh.elements.size());
  for (int e = 0; e < elements; ++e) transfer_element(from, y, to, e, out);
  return out;
}

}  // namespace snapthrough
