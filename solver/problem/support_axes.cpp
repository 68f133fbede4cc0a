#include "solver/problem/support_axes.h"

#include <cmath>
#include <cstddef>

#include "solver/mesh/dof_map.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

SupportAxes::SupportAxes(const Structure& structure) : structure_(structure) {
  for (int j = 0; j < structure.nodes; ++j) {
    const double angle = structure.supports[j].angle;
    turns_.push_back({std::cos(angle), std::sin(angle)});
    if (angle != 0.0) inclined_.push_back(j);
  }
  find_free_rotations();
  const Index unknowns = DofMap::count(structure.nodes);
  for (Index i = 0; i < unknowns; ++i)
    if (is_fixed(i)) fixed_.push_back(i);
}

/// A node rotation is free when all members there are released and no support or spring to ground acts on it.
/// check() refuses a rotational spring between nodes one of which is free without it.
void SupportAxes::find_free_rotations() {
  free_rotation_.assign(static_cast<std::size_t>(structure_.nodes), 1);
  const int unknowns = DofMap::count(structure_.nodes);
  for (const ElementDofs& dofs : structure_.dofs) {
    for (const int dof : {dofs.a[2], dofs.b[2]})
      if (dof < unknowns) free_rotation_[DofMap::node(dof)] = 0;
  }
  for (const NodeSpring& spring : structure_.node_springs)
    if (spring.row[2] != 0.0 && (spring.to < 0 || spring.to >= structure_.first_ground))
      free_rotation_[spring.node] = 0;
  for (const JointSpring& joint : structure_.joints) free_rotation_[DofMap::node(joint.node_rotation)] = 0;
}

bool SupportAxes::is_fixed(Index unknown) const {
  if (unknown >= DofMap::count(structure_.nodes)) return false;
  const Index node = DofMap::node(unknown);
  const Index component = DofMap::component(unknown);
  return (component == 2 && free_rotation_[node]) || structure_.supports[node].fixed[component];
}

/// Cosine and sine of the support angle at the node of an unknown.
std::array<double, 2> SupportAxes::turn_of(int unknown) const {
  return unknown < DofMap::count(structure_.nodes) ? turns_[static_cast<std::size_t>(DofMap::node(unknown))]
                                                   : std::array{1.0, 0.0};
}

Matrix3d SupportAxes::axes_of(const std::array<int, 3>& dofs) const {
  const auto [c, s] = turn_of(dofs[0]);
  Matrix3d axes = Matrix3d::Identity();
  axes(0, 0) = c;
  axes(0, 1) = -s;
  axes(1, 0) = s;
  axes(1, 1) = c;
  return axes;
}

Vector3d SupportAxes::components(const Eigen::Ref<const VectorXd>& y, int node) const {
  const auto [c, s] = turns_[static_cast<std::size_t>(node)];
  const auto [ux, uy, turn] = DofMap::of(node);
  return {c * y[ux] + s * y[uy], -s * y[ux] + c * y[uy], y[turn]};
}

void SupportAxes::to_supports(Eigen::Ref<VectorXd> f) const {
  for (const int j : inclined_) DofMap::at(f, j) = components(f, j);
}

void SupportAxes::from_supports(Eigen::Ref<VectorXd> x) const {
  for (const int j : inclined_) {
    const auto [c, s] = turns_[static_cast<std::size_t>(j)];
    const Eigen::Vector2d u = DofMap::displacement(x, j);
    DofMap::displacement(x, j) << c * u[0] - s * u[1], s * u[0] + c * u[1];
  }
}

void SupportAxes::release(Eigen::Ref<VectorXd> f) const {
  to_supports(f);
  for (const Index row : fixed_) f[row] = 0.0;
}

VectorXd SupportAxes::imposed_motion(const VectorXd& rows) const {
  VectorXd out = VectorXd::Zero(rows.size());
  for (const Index row : fixed_) {
    if (rows[row] == 0.0) continue;
    const int node = static_cast<int>(DofMap::node(row));
    DofMap::at(out, node) += rows[row] * axes_of(DofMap::of(node)).col(DofMap::component(row));
  }
  return out;
}

double SupportAxes::work(const Eigen::Ref<const VectorXd>& forces,
                         const Eigen::Ref<const VectorXd>& motion) const {
  double out = forces.dot(motion);
  for (const int j : inclined_) {
    const auto [c, s] = turns_[static_cast<std::size_t>(j)];
    const Eigen::Vector2d f = DofMap::displacement(forces, j);
    const Eigen::Vector2d u = DofMap::displacement(motion, j);
    out += f[0] * ((c - 1.0) * u[0] + s * u[1]) + f[1] * (-s * u[0] + (c - 1.0) * u[1]);
  }
  return out;
}

}  // namespace snapthrough
