#include "solver/report/resultant.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/mesh/dof_map.h"

namespace snapthrough {
RigidMotions::RigidMotions(const Structure& structure, const Eigen::VectorXd& y)
    : structure_(structure),
      x_(Eigen::VectorXd::Zero(structure.size)),
      y_(Eigen::VectorXd::Zero(structure.size)),
      rotation_(Eigen::VectorXd::Zero(structure.size)) {
  const ResolvedModel& model = *structure.model;
  const int p = structure.mesh.order;
  const double L = structure.scales.length;
  const double moved = structure.geometry == Geometry::linear ? 0.0 : 1.0;
  const auto set_node = [&](const std::array<int, 3>& dofs, double x, double z) {
    x_[dofs[0]] = 1.0;
    y_[dofs[1]] = 1.0;
    rotation_[dofs[0]] = -(z + moved * y[dofs[1]]);
    rotation_[dofs[1]] = x + moved * y[dofs[0]];
    rotation_[dofs[2]] = 1.0;
  };
  // nodes first, for nodes without members; the ends of members may be offset from their nodes
  for (int j = 0; j < structure.first_ground; ++j)
    set_node(DofMap::of(j), (model.nodes[j].x - structure.origin[0]) / L,
             (model.nodes[j].y - structure.origin[1]) / L);
  std::vector<bool> is_placed(static_cast<std::size_t>(structure.size), false);
  for (std::size_t e = structure.dofs.size(); e-- > 0;) {
    const MeshElement& cell = structure.mesh.elements[e];
    const ElementDofs& dofs = structure.dofs[e];
    const StressFreeAxis& axis = *structure.stress_free[cell.member];
    const ElementShape shape = shape_of_element(structure, static_cast<int>(e));
    for (const bool end : {true, false}) {
      const StressFreePoint at = axis.at(axis.perfect().length() * (end ? cell.to : cell.from));
      const std::array<int, 3>& node = end ? dofs.b : dofs.a;
      const double before[2] = {rotation_[node[1]], -rotation_[node[0]]};
      set_node(node, at.x / L, at.y / L);
      const auto j = static_cast<std::size_t>(node[0]);
      if (is_placed[j])
        apart_ =
            std::max(apart_, std::hypot(rotation_[node[1]] - before[0], -rotation_[node[0]] - before[1]));
      is_placed[j] = true;
    }
    for (int q = 0; q < p; ++q) {
      rotation_[dofs.v + q] = -(shape.t[q][1] + moved * y[dofs.v + p + q]);
      rotation_[dofs.v + p + q] = shape.t[q][0] + moved * y[dofs.v + q];
    }
  }
}

Wrench RigidMotions::work(const Eigen::VectorXd& forces) const {
  return {forces.dot(x_), forces.dot(y_), forces.dot(rotation_)};
}

Wrench RigidMotions::work_without_sign(const Eigen::VectorXd& forces) const {
  const Eigen::VectorXd sizes = forces.cwiseAbs();
  return {sizes.dot(x_), sizes.dot(y_), sizes.dot(rotation_.cwiseAbs())};
}

Wrench RigidMotions::work(const SparseRow& row) const {
  return {row.dot(x_), row.dot(y_), row.dot(rotation_)};
}

Wrench RigidMotions::work(const SupportSpring& support) const {
  return {value(support, x_).value, value(support, y_).value, value(support, rotation_).value};
}

RigidMotions::Reading RigidMotions::value(const SupportSpring& support, const Eigen::VectorXd& y) const {
  const ElementDofs& dofs = structure_.dofs[support.element];
  const int p = structure_.mesh.order;
  Reading out;
  for (int c = 0; c < 3; ++c) {
    out.value += support.a[c] * y[dofs.a[c]];
    out.size += std::abs(support.a[c] * y[dofs.a[c]]);
    for (int q = 0; q < p; ++q) out.value += support.v[q][c] * y[dofs.v + c * p + q];
  }
  const double moved = support.ground.along(support.a, y.data());
  out.value -= moved;
  out.size += std::abs(moved);
  return out;
}

Resultant RigidMotions::unscaled(const Wrench& scaled) const {
  const double F = structure_.scales.force;
  Resultant out{F * scaled[0], F * scaled[1], F * structure_.scales.length * scaled[2]};
  out.moment += structure_.origin[0] * out.fy - structure_.origin[1] * out.fx;
  return out;
}

}  // namespace snapthrough
