#include "solver/discrete/transfer.h"

#include <array>
#include <span>

#include "solver/mesh/dof_map.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {
namespace {

using Block = Eigen::Ref<const Eigen::MatrixXd>;

/// Sum of the weights times the values.
double sum_of(std::span<const double> weights, const double* values) {
  double sum = 0.0;
  for (std::size_t q = 0; q < weights.size(); ++q) sum += weights[q] * values[q];
  return sum;
}

/// Transfers states to the unknowns at the Gauss points of one element of `to`.
void transfer_inside(const Structure& from, const Block& y, const Structure& to, int element,
                     Eigen::MatrixXd& out) {
  const MeshElement& cell = to.mesh.elements[element];
  const ElementDofs& dofs = to.dofs[element];
  const CollocationRule& target = CollocationRule::of(to.mesh.order);
  const CollocationRule& source = CollocationRule::of(from.mesh.order);
  const int p = to.mesh.order;
  const int old_p = from.mesh.order;
  for (int q = 0; q < p; ++q) {
    const MeshPlace at =
        place_of(from.mesh, cell.member, cell.from + target.point(q) * (cell.to - cell.from));
    const ElementDofs& old = from.dofs[at.element];
    std::array<double, kMaxOrder> l{};
    source.values_at(at.xi, std::span(l).first(old_p));
    const auto weights = std::span<const double>(l).first(old_p);
    for (Eigen::Index j = 0; j < y.cols(); ++j) {
      const double* known = y.col(j).data();
      double* wanted = out.col(j).data();
      for (int c = 0; c < 3; ++c) {
        wanted[dofs.v + c * p + q] = sum_of(weights, known + old.v + c * old_p);
        wanted[dofs.s + c * p + q] = sum_of(weights, known + old.s + c * old_p);
      }
    }
  }
}

/// Transfers states to the multipliers of one element of `to` and to the displacements of its end.
void transfer_end(const Structure& from, const Block& y, const Structure& to, int element,
                  Eigen::MatrixXd& out) {
  const MeshElement& cell = to.mesh.elements[element];
  const ElementDofs& dofs = to.dofs[element];
  // the element that ends at this place or contains it
  MeshPlace end = place_of(from.mesh, cell.member, cell.to);
  if (end.xi == 0.0 && end.element > from.mesh.first[cell.member]) end = {end.element - 1, 1.0};
  const ElementDofs& old = from.dofs[end.element];
  const int old_p = from.mesh.order;
  std::array<double, kMaxOrder> a{};
  CollocationRule::of(old_p).integrals_at(end.xi, std::span(a).first(old_p));
  const auto weights = std::span<const double>(a).first(old_p);
  const double length = length_of_element(from, end.element);
  const bool inside = dofs.b[0] >= DofMap::first(to.first_stop_node);
  for (Eigen::Index j = 0; j < y.cols(); ++j)
    for (int c = 0; c < 3; ++c) {
      // the multiplier enters the equations linearly, so that any value is a valid starting point
      out(dofs.m + c, j) = y(old.m + c, j);
      if (inside)
        out(dofs.b[c], j) = y(old.a[c], j) + length * sum_of(weights, y.col(j).data() + old.v + c * old_p);
    }
}

}  // namespace

Eigen::MatrixXd transfer(const Structure& from, const Block& y, const Structure& to) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(to.size, y.cols());
  const Eigen::Index shared = DofMap::first<Eigen::Index>(from.first_stop_node);
  out.topRows(shared) = y.topRows(shared);
  out.middleRows(DofMap::count(to.nodes), to.releases) =
      y.middleRows(DofMap::count(from.nodes), from.releases);
  for (std::size_t i = 0; to.stops > 0 && i < to.spring_laws.size(); ++i)
    if (const int old = from.spring_laws[i].force_unknown; old >= 0 && to.spring_laws[i].force_unknown >= 0)
      out.row(to.spring_laws[i].force_unknown) = y.row(old);
  const int elements = static_cast<int>(to.mesh.elements.size());
  for (int e = 0; e < elements; ++e) {
    transfer_inside(from, y, to, e, out);
    transfer_end(from, y, to, e, out);
  }
  return out;
}

}  // namespace snapthrough
