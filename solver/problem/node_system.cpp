#include "solver/problem/node_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "solver/mesh/dof_map.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

NodeSystem::NodeSystem(const Structure& structure, const SupportAxes& axes)
    : structure_(structure), axes_(axes), parts_(structure.parts_between_nodes.size() - 1) {
  condensed_forces_.resize(structure.dofs.size());
  chains_.resize(parts_);
  for (Index i = 0; i < multiplier(parts_); ++i)
    if (!axes_.is_fixed(i)) free_.push_back(i);
}

void NodeSystem::set_holds(const SharedHolds& holds) {
  holds_ = holds;
  planned_ = false;
  if (!holds_) return;
  hold_rows_.resize(holds_->motions.rows(), holds_->motions.cols());
  VectorXd column(structure_.size);
  for (Index i = 0; i < hold_rows_.cols(); ++i) {
    column.setZero();
    column.head(hold_rows_.rows()) = holds_->motions.col(i);
    axes_.to_supports(column);
    hold_rows_.col(i) = std::sqrt(holds_->stiffness) * column.head(hold_rows_.rows());
  }
}

TangentReport NodeSystem::factorise(std::span<const CondensedElement> condensed,
                                    const NodeSpringWork& springs, const JointWork& joints) {
  TangentReport report;
  for (std::size_t part = 0; part < parts_; ++part) {
    chains_[part].factorise(of_part(condensed, part));
    report.negative += chains_[part].ends().negative;
    report.log_abs_det += chains_[part].ends().log_det;
  }
  if (!planned_) plan();
  assemble(springs, joints);
  factor_.factorise(blocks_);
  const auto holds = static_cast<int>(holds_ ? holds_->motions.cols() : 0);
  report.negative +=
      factor_.inertia().negative - DofMap::count(static_cast<int>(parts_)) - holds - springs.stops();
  report.log_abs_det += factor_.log_abs_det() - springs.log_abs_det_of_stops();
  return report;
}

/// Collects the rows that each block couples: members, node springs, joints, held nodes.
void NodeSystem::plan() {
  rows_.clear();
  for (std::size_t part = 0; part < parts_; ++part) {
    const std::array<int, 3>& a = structure_.dofs[first_of(part)].a;
    const std::array<int, 3>& b = structure_.dofs[first_of(part + 1) - 1].b;
    const auto force = static_cast<int>(multiplier(part));
    rows_.push_back({a[0], a[1], a[2], b[0], b[1], b[2], force, force + 1, force + 2});
  }
  const auto add = [](int node, std::vector<int>& rows) {
    const auto unknowns = DofMap::of(node);
    rows.insert(rows.end(), unknowns.begin(), unknowns.end());
  };
  for (const NodeSpring& spring : structure_.node_springs) {
    std::vector<int>& rows = rows_.emplace_back();
    add(spring.node, rows);
    if (spring.to >= 0) add(spring.to, rows);
    if (spring.is_stop()) rows.push_back(spring.force_unknown);
    if (spring.without_force >= 0) rows.push_back(spring.without_force);
  }
  for (const JointSpring& joint : structure_.joints)
    rows_.push_back({joint.node_rotation, joint.end_rotation});
  const auto scalars = static_cast<int>(multiplier(parts_));
  const auto holds = static_cast<int>(holds_ ? holds_->motions.cols() : 0);
  for (int node = 0; holds > 0 && node < structure_.first_ground; ++node) {
    std::vector<int>& rows = rows_.emplace_back();
    add(node, rows);
    for (int h = 0; h < holds; ++h) rows.push_back(scalars + h);
  }
  blocks_.resize(rows_.size());
  std::vector<int> number(static_cast<std::size_t>(scalars + holds), -1);
  for (std::size_t i = 0; i < free_.size(); ++i) number[free_[i]] = static_cast<int>(i);
  for (int h = 0; h < holds; ++h) number[scalars + h] = static_cast<int>(free_.size()) + h;
  std::vector<std::vector<int>> blocks = rows_;
  for (std::vector<int>& block : blocks)
    for (int& row : block) row = number[row];
  factor_.analyse(static_cast<int>(free_.size()) + holds, std::move(blocks));
  planned_ = true;
}

void NodeSystem::assemble(const NodeSpringWork& springs, const JointWork& joints) {
  for (std::size_t part = 0; part < parts_; ++part) fill_part(part, blocks_[part]);
  for (std::size_t i = 0; i < structure_.node_springs.size(); ++i)
    fill_spring(springs, i, blocks_[parts_ + i]);
  const std::size_t first_joint = parts_ + structure_.node_springs.size();
  for (std::size_t i = 0; i < structure_.joints.size(); ++i) {
    const double k = joints.stiffness(i);
    blocks_[first_joint + i] = (MatrixXd(2, 2) << k, -k, -k, k).finished();
  }
  const std::size_t first_hold = first_joint + structure_.joints.size();
  for (std::size_t i = first_hold; i < blocks_.size(); ++i)
    fill_hold(static_cast<int>(i - first_hold), blocks_[i]);
}

void NodeSystem::fill_part(std::size_t part, MatrixXd& block) const {
  const CondensedElement& ends = chains_[part].ends();
  const Matrix3d Ta = axes_.axes_of(structure_.dofs[first_of(part)].a);
  const Matrix3d Tb = axes_.axes_of(structure_.dofs[first_of(part + 1) - 1].b);
  block.setZero(9, 9);  // start, end, end forces
  block.topLeftCorner<3, 3>() = Ta.transpose() * ends.K * Ta;
  block.bottomLeftCorner<3, 3>() = ends.X * Ta;
  block.block<3, 3>(6, 3) = Tb;
  block.bottomRightCorner<3, 3>() = -ends.F;
}

/// Writes the tangent stiffness of a spring at its node, and at the other node where it has one; last the row
/// of a stop or of a pretension, of which the spring has at most one. The pretension is prescribed, so that
/// its diagonal is not used.
void NodeSystem::fill_spring(const NodeSpringWork& springs, std::size_t spring, MatrixXd& block) const {
  const NodeSpring& at = structure_.node_springs[spring];
  const Matrix3d& tangent = springs.tangent(spring);
  const Matrix3d here = axes_.axes_of(DofMap::of(at.node));
  const Index moved = DofMap::count<Index>(at.to < 0 ? 1 : 2);
  const bool is_pretensioned = at.without_force >= 0;
  const Index size = moved + (at.is_stop() || is_pretensioned ? 1 : 0);
  block.setZero(size, size);
  block.topLeftCorner<3, 3>() = here.transpose() * tangent * here;
  if (at.is_stop()) {
    block.row(moved).head<3>() = springs.row_by_motion(spring).transpose() * here;
    block(moved, moved) = springs.row_by_force(spring);
  }
  if (at.to < 0) return;
  const Matrix3d there = axes_.axes_of(DofMap::of(at.to));
  block.block<3, 3>(3, 0) = -there.transpose() * tangent * here;
  block.block<3, 3>(3, 3) = there.transpose() * tangent * there;
  if (at.is_stop()) block.row(moved).segment<3>(3) = -springs.row_by_motion(spring).transpose() * there;
  if (!is_pretensioned) return;
  const Eigen::RowVector3d force = springs.force_by_pretension(spring).transpose();
  block.row(moved).head<3>() = force * here;
  block.row(moved).segment<3>(3) = -force * there;
}

/// Writes the rows of the holds at a node; the first node has the diagonal of the holds' forces.
void NodeSystem::fill_hold(int node, MatrixXd& block) const {
  const Index holds = hold_rows_.cols();
  const Index size = DofMap::count<Index>(1) + holds;
  block.setZero(size, size);
  block.bottomLeftCorner(holds, DofMap::components) =
      hold_rows_.middleRows<DofMap::components>(DofMap::first(node)).transpose();
  if (node == 0) block.diagonal().tail(holds).setConstant(-1.0);
}

/// Moves the constrained displacements to the right-hand side.
void NodeSystem::subtract_fixed(const Eigen::Ref<const VectorXd>& rhs, Eigen::Ref<VectorXd> reduced) const {
  const bool moved = std::ranges::any_of(axes_.fixed(), [&](const Index row) { return rhs[row] != 0.0; });
  if (!moved) return;
  for (std::size_t b = 0; b < rows_.size(); ++b) {
    const std::vector<int>& rows = rows_[b];
    const std::vector<int>& numbers = factor_.blocks()[b];
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (numbers[k] >= 0 || rhs[rows[k]] == 0.0) continue;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto [low, high] = std::minmax<Index>({static_cast<Index>(i), static_cast<Index>(k)});
        if (numbers[i] >= 0) reduced[numbers[i]] -= blocks_[b](high, low) * rhs[rows[k]];
      }
    }
  }
}

void NodeSystem::solve(ElementWork& elements, Eigen::Ref<MatrixXd> x) {
  const Index kept = structure_.before_elements();
  node_rhs_.resize(multiplier(parts_), kLanes);
  free_rhs_.resize(factor_.size(), kLanes);
  for (Index first = 0; first < x.cols(); first += kLanes) {
    const ColumnLanes lanes(x, first);
    const Index count = std::min<Index>(kLanes, x.cols() - first);
    elements.reduce(lanes, condensed_forces_);
    node_rhs_.topRows(kept).leftCols(count) = x.topRows(kept).middleCols(first, count);
    for (std::size_t part = 0; part < parts_; ++part) reduce_part(part, lanes, count);
    for (Index i = 0; i < count; ++i) solve_nodes(node_rhs_.col(i), free_rhs_.col(i));
    x.topRows(kept).middleCols(first, count) = node_rhs_.topRows(kept).leftCols(count);
    for (Index i = first; i < first + count; ++i) axes_.from_supports(x.col(i));
    for (std::size_t part = 0; part < parts_; ++part) recover_part(part, lanes, x.middleCols(first, count));
    elements.recover(lanes);
  }
}

/// Adds the right-hand sides at the ends of a part of a member.
void NodeSystem::reduce_part(std::size_t part, const ColumnLanes& lanes, Index count) {
  const auto dofs = of_part(structure_.dofs, part);
  const CondensedForces ends = chains_[part].reduce(of_part(condensed_forces_, part), dofs, lanes);
  const std::array<int, 3>& start = dofs.front().a;
  const Lanes3 ra = transposed_times(axes_.axes_of(start), ends.ra);
  for (Index i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) {
      if (!axes_.is_fixed(start[c])) node_rhs_(start[c], i) += ra[c][i];
      node_rhs_(multiplier(part) + c, i) = ends.rm[c][i];
    }
  }
}

/// Solves the equations of the nodes in place. @param reduced scratch, one entry per unknown of the system
void NodeSystem::solve_nodes(Eigen::Ref<VectorXd> rhs, Eigen::Ref<VectorXd> reduced) {
  reduced.setZero();
  for (std::size_t i = 0; i < free_.size(); ++i) reduced[static_cast<Index>(i)] = rhs[free_[i]];
  subtract_fixed(rhs, reduced);
  factor_.solve(reduced);
  for (std::size_t i = 0; i < free_.size(); ++i) rhs[free_[i]] = reduced[static_cast<Index>(i)];
}

/// Writes the end forces of a part of a member and the solution between its elements.
void NodeSystem::recover_part(std::size_t part, const ColumnLanes& lanes, Eigen::Ref<MatrixXd> x) const {
  const auto dofs = of_part(structure_.dofs, part);
  x.middleRows<3>(dofs.back().m) = node_rhs_.middleRows<3>(multiplier(part)).leftCols(x.cols());
  chains_[part].recover(of_part(condensed_forces_, part), dofs, lanes);
}

}  // namespace snapthrough
