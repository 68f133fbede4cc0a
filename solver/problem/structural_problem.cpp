#include "solver/problem/structural_problem.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "solver/numeric/cancelled.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// What counts as zero in a state; ratios. Source: docs/decisions/0009 and 0022.
struct ProblemTolerances {
  static constexpr double touching = 1e-9;  ///< distance of supports, over the largest displacement
  static constexpr double unloaded = 1e-6;  ///< force of touching supports, over the largest force
  /// Axial force over the largest, below which largest_critical_load_scale() ignores a member.
  static constexpr double small_axial_force = 1e-2;
  static constexpr double most_rounding = 1e-7;  ///< residual_rounding() of supports too stiff for double
};

/// Displacement gradient of the initial strains and prescribed displacements of a load pattern: the largest
/// of strain, curvature times member length, and displacement over the structure's length.
/// @param load vector of the pattern; its initial strains are in the rows of section forces
double imposed_gradient(const Structure& structure, const VectorXd& load,
                        std::array<double, 3> NodeSupport::*displacement) {
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const int p = rule.order();
  double gradient = 0.0;
  for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
    const double element = length_of_element(structure, static_cast<int>(e));
    const std::size_t member = structure.mesh.elements[e].member;
    const double length = structure.axes[member]->length() / structure.scales.length;
    for (int q = 0; q < p; ++q) {
      const double weight = element * rule.weight(q);
      const Index row = structure.dofs[e].s + q;
      gradient =
          std::max({gradient, std::abs(load[row]) / weight, length * std::abs(load[row + 2 * p]) / weight});
    }
  }
  for (const NodeSupport& support : structure.supports)
    for (const double value : support.*displacement) gradient = std::max(gradient, std::abs(value));
  return gradient;
}

}  // namespace

StructuralProblem::StructuralProblem(const Structure& structure)
    : structure_(structure),
      stop_(structure.stop),
      parts_(structure.parts_between_nodes.size() - 1),
      follower_loads_(structure.follower_ends, structure.follower_forces),
      springs_(structure.node_springs) {
  condensed_.resize(structure.dofs.size());
  condensed_forces_.resize(structure.dofs.size());
  for (int j = 0; j < structure.nodes; ++j) {
    const double angle = structure.supports[j].angle;
    turns_.push_back({std::cos(angle), std::sin(angle)});
    if (angle != 0.0) inclined_.push_back(j);
  }
  chains_.resize(parts_);
  elements_ = structure.elements->make_work();
  // A node rotation is free when all members there are released and no support or spring to ground acts on
  // it. check() refuses a rotational spring between nodes one of which is free without it.
  free_rotation_.assign(static_cast<std::size_t>(structure.nodes), 1);
  for (const ElementDofs& dofs : structure.dofs) {
    for (const int dof : {dofs.a[2], dofs.b[2]})
      if (dof < 3 * structure.nodes) free_rotation_[dof / 3] = 0;
  }
  for (const NodeSpring& spring : structure.node_springs)
    if (spring.row[2] != 0.0 && (spring.to < 0 || spring.to >= structure.first_ground))
      free_rotation_[spring.node] = 0;
  for (const JointSpring& joint : structure.joints) free_rotation_[joint.node_rotation / 3] = 0;
  const Index n = structure.before_elements() + 3 * static_cast<Index>(parts_);
  for (Index i = 0; i < n; ++i) (is_fixed(i) ? fixed_ : free_).push_back(i);
  proportional_force_ = largest_load({1.0, 0.0});
  constant_force_ = largest_load({0.0, 1.0});
  const double softest = *std::min_element(structure.euler_loads.begin(), structure.euler_loads.end());
  proportional_imposed_ =
      softest * imposed_gradient(structure, structure.proportional_load, &NodeSupport::proportional);
  constant_imposed_ = softest * imposed_gradient(structure, structure.constant_load, &NodeSupport::constant);
}

bool StructuralProblem::is_fixed(Index scalar) const {
  if (scalar >= 3 * structure_.nodes) return false;
  if (scalar % 3 == 2 && free_rotation_[scalar / 3]) return true;
  return structure_.supports[scalar / 3].fixed[scalar % 3];
}

/// Cosine and sine of the support angle at the node of a displacement unknown.
std::array<double, 2> StructuralProblem::turn_of(int dof) const {
  return dof < 3 * structure_.nodes ? turns_[static_cast<std::size_t>(dof / 3)] : std::array{1.0, 0.0};
}

/// Support axes as columns, in global components.
Matrix3d StructuralProblem::axes_of(const std::array<int, 3>& dofs) const {
  const auto [c, s] = turn_of(dofs[0]);
  Matrix3d axes = Matrix3d::Identity();
  axes(0, 0) = c;
  axes(0, 1) = -s;
  axes(1, 0) = s;
  axes(1, 1) = c;
  return axes;
}

void StructuralProblem::add_node_springs(const VectorXd& y, const Regime& regime, VectorXd& f) {
  springs_.evaluate(y, regime);
  springs_.add_forces(f);
  add_joint_moments(structure_, y, f);
}

void StructuralProblem::force_along(const VectorXd& motion, VectorXd& out) const {
  out.setZero(size());
  out.head(motion.size()) = motion;
  turn_to_supports(out);
}

void StructuralProblem::metric_forces(const Eigen::Ref<const VectorXd>& x, Eigen::Ref<VectorXd> out) const {
  out = structure_.metric.cwiseProduct(x);
  release_rows(out);
}

VectorXd StructuralProblem::imposed_motion(const VectorXd& rows) const {
  VectorXd out = VectorXd::Zero(rows.size());
  for (const Index row : fixed_) {
    if (row >= 3 * structure_.nodes || rows[row] == 0.0) continue;
    const auto [c, s] = turn_of(static_cast<int>(row));
    const Index node = row - row % 3;
    if (row % 3 == 2) {
      out[row] += rows[row];
    } else {
      out[node] += (row % 3 == 0 ? c : -s) * rows[row];
      out[node + 1] += (row % 3 == 0 ? s : c) * rows[row];
    }
  }
  return out;
}

double StructuralProblem::work(const Eigen::Ref<const VectorXd>& forces,
                               const Eigen::Ref<const VectorXd>& motion) const {
  double out = forces.dot(motion);
  for (const int j : inclined_) {
    const auto [c, s] = turn_of(3 * j);
    const double ux = motion[3 * j];
    const double uy = motion[3 * j + 1];
    out += forces[3 * j] * ((c - 1.0) * ux + s * uy) + forces[3 * j + 1] * (-s * ux + (c - 1.0) * uy);
  }
  return out;
}

void StructuralProblem::set_holds(const SharedHolds& holds) {
  if (holds == holds_) return;
  holds_ = holds;
  planned_ = false;
  if (!holds_) return;
  hold_rows_.resize(holds_->motions.rows(), holds_->motions.cols());
  VectorXd column;
  for (Index i = 0; i < hold_rows_.cols(); ++i) {
    force_along(holds_->motions.col(i), column);
    hold_rows_.col(i) = std::sqrt(holds_->stiffness) * column.head(hold_rows_.rows());
  }
}

void StructuralProblem::add_holds(const VectorXd& y, VectorXd& f) const {
  if (!holds_) return;
  const Index rows = holds_->motions.rows();
  const VectorXd moved = holds_->motions.transpose() * y.head(rows) - holds_->at;
  f.head(rows) += holds_->stiffness * (holds_->motions * moved);
}

/// Transforms the nodal rows of f into support axes.
void StructuralProblem::turn_to_supports(Eigen::Ref<VectorXd> f) const {
  for (const int j : inclined_) {
    const auto [c, s] = turn_of(3 * j);
    const double fx = f[3 * j];
    const double fy = f[3 * j + 1];
    f[3 * j] = c * fx + s * fy;
    f[3 * j + 1] = -s * fx + c * fy;
  }
}

/// Transforms the nodal rows of f into support axes and replaces the constrained rows by the constraints.
void StructuralProblem::constrain_residual(const VectorXd& y, double lambda, VectorXd& f) const {
  turn_to_supports(f);
  const auto [proportional, constant] = factors(lambda);
  for (int j = 0; j < structure_.nodes; ++j) {
    const NodeSupport& support = structure_.supports[j];
    const auto [c, s] = turn_of(3 * j);
    const double local[3] = {c * y[3 * j] + s * y[3 * j + 1], -s * y[3 * j] + c * y[3 * j + 1], y[3 * j + 2]};
    for (int k = 0; k < 3; ++k)
      if (is_fixed(3 * j + k))
        f[3 * j + k] = local[k] - proportional * support.proportional[k] - constant * support.constant[k];
  }
}

/// Starts the residual with minus the loads at points and along members.
void StructuralProblem::start_residual(const VectorXd& y, double lambda, const Regime& regime,
                                       VectorXd& f) const {
  const auto [proportional, constant] = factors(lambda);
  f = -proportional * structure_.proportional_load - constant * structure_.constant_load;
  if (!regime.small_displacements) follower_loads_.add_load(y, {-proportional, -constant}, f);
}

Regime StructuralProblem::regime_of(const Regime& asked) const {
  Regime regime = asked;
  regime.small_displacements = asked.small_displacements || structure_.geometry == Geometry::linear;
  return regime;
}

void StructuralProblem::find_residual(const VectorXd& y, double lambda, const Regime& asked, VectorXd& f) {
  end_if_asked(stop_);
  const Regime regime = regime_of(asked);
  start_residual(y, lambda, regime, f);
  elements_->add_residual(y, factors(lambda), regime, f);
  add_node_springs(y, regime, f);
  add_holds(y, f);
  constrain_residual(y, lambda, f);
}

void StructuralProblem::load(const VectorXd& y, double, VectorXd& out) {
  const bool constant = stage_ == Stage::constant;
  out = constant ? structure_.constant_load : structure_.proportional_load;
  elements_->add_pressure_load(y, factor_rates(), structure_.geometry == Geometry::linear, out);
  follower_loads_.add_load(y, factor_rates(), out);
  turn_to_supports(out);
  for (int j = 0; j < structure_.nodes; ++j) {
    const NodeSupport& support = structure_.supports[j];
    for (int k = 0; k < 3; ++k)
      if (is_fixed(3 * j + k)) out[3 * j + k] = constant ? support.constant[k] : support.proportional[k];
  }
}

void StructuralProblem::fill_part(std::size_t part, MatrixXd& block) const {
  const CondensedElement& ends = chains_[part].ends();
  const Matrix3d Ta = axes_of(structure_.dofs[first_of(part)].a);
  const Matrix3d Tb = axes_of(structure_.dofs[first_of(part + 1) - 1].b);
  block.setZero(9, 9);  // start, end, end forces
  block.topLeftCorner<3, 3>() = Ta.transpose() * ends.K * Ta;
  block.bottomLeftCorner<3, 3>() = ends.X * Ta;
  block.block<3, 3>(6, 3) = Tb;
  block.bottomRightCorner<3, 3>() = -ends.F;
}

/// Writes the tangent stiffness of a spring at its node, and at the other node where it has one; last the row
/// of a stop.
void StructuralProblem::fill_spring(std::size_t spring, MatrixXd& block) const {
  const NodeSpring& at = structure_.node_springs[spring];
  const Matrix3d& tangent = springs_.tangent(spring);
  const auto axes = [this](int node) { return axes_of({3 * node, 3 * node + 1, 3 * node + 2}); };
  const Matrix3d here = axes(at.node);
  const Index moved = at.to < 0 ? 3 : 6;
  const Index size = moved + (at.is_stop() ? 1 : 0);
  block.setZero(size, size);
  block.topLeftCorner<3, 3>() = here.transpose() * tangent * here;
  if (at.is_stop()) {
    block.row(moved).head<3>() = springs_.row_by_motion(spring).transpose() * here;
    block(moved, moved) = springs_.row_by_force(spring);
  }
  if (at.to < 0) return;
  const Matrix3d there = axes(at.to);
  block.block<3, 3>(3, 0) = -there.transpose() * tangent * here;
  block.block<3, 3>(3, 3) = there.transpose() * tangent * there;
  if (at.is_stop()) block.row(moved).segment<3>(3) = -springs_.row_by_motion(spring).transpose() * there;
}

/// Collects the rows that each block of the node system couples: members, node springs, joints, held nodes.
void StructuralProblem::plan_nodes() {
  node_rows_.clear();
  for (std::size_t part = 0; part < parts_; ++part) {
    const std::array<int, 3>& a = structure_.dofs[first_of(part)].a;
    const std::array<int, 3>& b = structure_.dofs[first_of(part + 1) - 1].b;
    const auto force = static_cast<int>(multiplier(part));
    node_rows_.push_back({a[0], a[1], a[2], b[0], b[1], b[2], force, force + 1, force + 2});
  }
  for (const NodeSpring& spring : structure_.node_springs) {
    node_rows_.push_back({3 * spring.node, 3 * spring.node + 1, 3 * spring.node + 2});
    if (spring.to >= 0)
      for (int c = 0; c < 3; ++c) node_rows_.back().push_back(3 * spring.to + c);
    if (spring.is_stop()) node_rows_.back().push_back(spring.force_unknown);
  }
  for (const JointSpring& joint : structure_.joints)
    node_rows_.push_back({joint.node_rotation, joint.end_rotation});
  const auto scalars = static_cast<int>(multiplier(parts_));
  const auto holds = static_cast<int>(holds_ ? holds_->motions.cols() : 0);
  for (int node = 0; holds > 0 && node < structure_.first_ground; ++node) {
    node_rows_.push_back({3 * node, 3 * node + 1, 3 * node + 2});
    for (int h = 0; h < holds; ++h) node_rows_.back().push_back(scalars + h);
  }
  node_blocks_.resize(node_rows_.size());
  std::vector<int> number(static_cast<std::size_t>(scalars + holds), -1);
  for (std::size_t i = 0; i < free_.size(); ++i) number[free_[i]] = static_cast<int>(i);
  for (int h = 0; h < holds; ++h) number[scalars + h] = static_cast<int>(free_.size()) + h;
  std::vector<std::vector<int>> blocks = node_rows_;
  for (std::vector<int>& block : blocks)
    for (int& row : block) row = number[row];
  factor_.analyse(static_cast<int>(free_.size()) + holds, std::move(blocks));
  planned_ = true;
}

void StructuralProblem::assemble_nodes() {
  if (!planned_) plan_nodes();
  for (std::size_t part = 0; part < parts_; ++part) fill_part(part, node_blocks_[part]);
  for (std::size_t i = 0; i < structure_.node_springs.size(); ++i) fill_spring(i, node_blocks_[parts_ + i]);
  const std::size_t first_joint = parts_ + structure_.node_springs.size();
  for (std::size_t i = 0; i < structure_.joints.size(); ++i) {
    const double k = structure_.joints[i].stiffness;
    node_blocks_[first_joint + i] = (MatrixXd(2, 2) << k, -k, -k, k).finished();
  }
  const std::size_t first_hold = first_joint + structure_.joints.size();
  for (std::size_t i = first_hold; i < node_blocks_.size(); ++i) {
    const Index holds = hold_rows_.cols();
    MatrixXd& block = node_blocks_[i];
    block.setZero(3 + holds, 3 + holds);
    block.bottomLeftCorner(holds, 3) =
        hold_rows_.middleRows<3>(3 * static_cast<Index>(i - first_hold)).transpose();
    if (i == first_hold) block.diagonal().tail(holds).setConstant(-1.0);
  }
  factor_.factorise(node_blocks_);
}

TangentReport StructuralProblem::factorise(const VectorXd& y, double lambda, const Regime& asked,
                                           VectorXd& f) {
  end_if_asked(stop_);
  const Regime regime = regime_of(asked);
  start_residual(y, lambda, regime, f);
  elements_->linearise(y, factors(lambda), regime, f, condensed_);
  add_node_springs(y, regime, f);
  add_holds(y, f);
  TangentReport report;
  for (std::size_t part = 0; part < parts_; ++part) {
    const auto first = static_cast<std::size_t>(first_of(part));
    const auto count = static_cast<std::size_t>(first_of(part + 1)) - first;
    chains_[part].factorise(std::span(condensed_).subspan(first, count));
    report.negative += chains_[part].ends().negative;
    report.log_abs_det += chains_[part].ends().log_det;
  }
  assemble_nodes();
  corrected_ = !follower_loads_.empty() && !regime.small_displacements;
  const auto holds = static_cast<int>(holds_ ? holds_->motions.cols() : 0);
  report.negative += factor_.inertia().negative - 3 * static_cast<int>(parts_) - holds - springs_.stops();
  report.log_abs_det += factor_.log_abs_det() - springs_.log_abs_det_of_stops();
  add_couplings(report);
  if (corrected_) add_follower_loads(y, lambda, report);
  constrain_residual(y, lambda, f);
  return report;
}

/// Corrects determinant and count of the tangent without couplings between elements.
void StructuralProblem::add_couplings(TangentReport& report) {
  couplings_.prepare(elements_->couplings(), size(), [this](Eigen::Ref<MatrixXd> x) {
    for (Index i = 0; i < x.cols(); ++i) release_rows(x.col(i));
    solve_uncoupled(x);
  });
  report.negative -= couplings_.negative();
  report.log_abs_det += couplings_.log_abs_det();
}

/// Corrects determinant and count of the symmetric part for the follower loads. A nonsymmetric tangent
/// changes its divergence stability where its determinant changes sign; the count is changed to match that
/// parity.
void StructuralProblem::add_follower_loads(const VectorXd& y, double lambda, TangentReport& report) {
  const double det = follower_loads_.prepare(y, factors(lambda), [this](Eigen::Ref<MatrixXd> x) {
    for (Index i = 0; i < x.cols(); ++i) release_rows(x.col(i));
    solve_symmetric(x);
  });
  report.log_abs_det += std::log(std::max(std::abs(det), std::numeric_limits<double>::min()));
  if (det < 0.0) report.negative += report.negative > 0 ? -1 : 1;
  report.parity_only = true;
}

void StructuralProblem::solve(Eigen::Ref<MatrixXd> x) {
  solve_symmetric(x);
  if (!corrected_) return;
  for (Index i = 0; i < x.cols(); ++i) follower_loads_.correct(x.col(i));
}

void StructuralProblem::subtract_fixed(const Eigen::Ref<const VectorXd>& rhs,
                                       Eigen::Ref<VectorXd> reduced) const {
  const bool moved = std::any_of(fixed_.begin(), fixed_.end(), [&](Index row) { return rhs[row] != 0.0; });
  if (!moved) return;
  for (std::size_t b = 0; b < node_rows_.size(); ++b) {
    const std::vector<int>& rows = node_rows_[b];
    const std::vector<int>& numbers = factor_.blocks()[b];
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (numbers[k] >= 0 || rhs[rows[k]] == 0.0) continue;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto [low, high] = std::minmax<Index>({static_cast<Index>(i), static_cast<Index>(k)});
        if (numbers[i] >= 0) reduced[numbers[i]] -= node_blocks_[b](high, low) * rhs[rows[k]];
      }
    }
  }
}

/// Moves what prescribed displacements of the ground do to the elements to the right-hand sides.
void StructuralProblem::subtract_ground(Eigen::Ref<MatrixXd> x) const {
  const Index first = 3 * structure_.first_ground;
  const Index count = 3 * (structure_.first_stop_node - structure_.first_ground);
  VectorXd forces;
  for (Index i = 0; count > 0 && i < x.cols(); ++i) {
    if ((x.col(i).segment(first, count).array() == 0.0).all()) continue;
    forces.setZero(size());
    elements_->add_ground_forces(x.col(i).data(), forces.data());
    release_rows(forces);
    x.col(i) -= forces;
  }
}

void StructuralProblem::solve_symmetric(Eigen::Ref<MatrixXd> x) {
  solve_uncoupled(x);
  for (Index i = 0; i < x.cols() && !couplings_.empty(); ++i) couplings_.correct(x.col(i));
}

void StructuralProblem::solve_uncoupled(Eigen::Ref<MatrixXd> x) {
  subtract_ground(x);
  const Index kept = structure_.before_elements();
  node_rhs_.resize(multiplier(parts_), kLanes);
  free_rhs_.resize(factor_.size(), kLanes);
  for (Index first = 0; first < x.cols(); first += kLanes) {
    const ColumnLanes lanes(x, first);
    const Index count = std::min<Index>(kLanes, x.cols() - first);
    elements_->reduce(lanes, condensed_forces_);
    node_rhs_.topRows(kept).leftCols(count) = x.topRows(kept).middleCols(first, count);
    for (std::size_t part = 0; part < parts_; ++part) reduce_part(part, lanes, count);
    for (Index i = 0; i < count; ++i) solve_nodes(node_rhs_.col(i), free_rhs_.col(i));
    x.topRows(kept).middleCols(first, count) = node_rhs_.topRows(kept).leftCols(count);
    for (Index i = first; i < first + count; ++i) turn_from_supports(x.col(i));
    for (std::size_t part = 0; part < parts_; ++part) recover_part(part, lanes, x.middleCols(first, count));
    elements_->recover(lanes);
  }
}

/// Adds the right-hand sides at the ends of a part of a member to the node system.
void StructuralProblem::reduce_part(std::size_t part, const ColumnLanes& lanes, Index count) {
  const auto first = static_cast<std::size_t>(first_of(part));
  const auto elements = static_cast<std::size_t>(first_of(part + 1)) - first;
  const CondensedForces ends =
      chains_[part].reduce(std::span(condensed_forces_).subspan(first, elements),
                           std::span(structure_.dofs).subspan(first, elements), lanes);
  const std::array<int, 3>& start = structure_.dofs[first].a;
  const Lanes3 ra = transposed_times(axes_of(start), ends.ra);
  for (Index i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) {
      if (!is_fixed(start[c])) node_rhs_(start[c], i) += ra[c][i];
      node_rhs_(multiplier(part) + c, i) = ends.rm[c][i];
    }
  }
}

/// Solves the node system in place. @param reduced scratch, one entry per unknown of the system
void StructuralProblem::solve_nodes(Eigen::Ref<VectorXd> rhs, Eigen::Ref<VectorXd> reduced) {
  reduced.setZero();
  for (std::size_t i = 0; i < free_.size(); ++i) reduced[static_cast<Index>(i)] = rhs[free_[i]];
  subtract_fixed(rhs, reduced);
  factor_.solve(reduced);
  for (std::size_t i = 0; i < free_.size(); ++i) rhs[free_[i]] = reduced[static_cast<Index>(i)];
}

/// Writes the end forces of a part of a member and the solution between its elements.
void StructuralProblem::recover_part(std::size_t part, const ColumnLanes& lanes,
                                     Eigen::Ref<MatrixXd> x) const {
  const auto first = static_cast<std::size_t>(first_of(part));
  const auto elements = static_cast<std::size_t>(first_of(part + 1)) - first;
  x.middleRows<3>(structure_.dofs[first + elements - 1].m) =
      node_rhs_.middleRows<3>(multiplier(part)).leftCols(x.cols());
  chains_[part].recover(std::span(condensed_forces_).subspan(first, elements),
                        std::span(structure_.dofs).subspan(first, elements), lanes);
}

/// Transforms the nodal rows of x from support axes.
void StructuralProblem::turn_from_supports(Eigen::Ref<VectorXd> x) const {
  for (const int j : inclined_) {
    const auto [c, s] = turn_of(3 * j);
    const double ux = x[3 * j];
    const double uy = x[3 * j + 1];
    x[3 * j] = c * ux - s * uy;
    x[3 * j + 1] = s * ux + c * uy;
  }
}

/// Distances at which supports count as touching at y, from the largest displacement and force.
TouchingDistance StructuralProblem::touching_distance(const VectorXd& y) const {
  const double largest = y.head(3 * structure_.nodes).lpNorm<Eigen::Infinity>();
  return {ProblemTolerances::touching * largest + Rounding::coordinate,
          ProblemTolerances::unloaded * largest_force(y, 0.0),
          Rounding::displacement * largest + Rounding::coordinate};
}

/// Displacement of a spring at a node.
double StructuralProblem::displacement(const NodeSpring& spring, const VectorXd& y,
                                       bool small_displacements) const {
  return spring.motion(y, small_displacements || structure_.geometry == Geometry::linear).w;
}

FrozenContact StructuralProblem::frozen_contact(const VectorXd& y, bool small_displacements) const {
  const double tolerance = touching_distance(y).any;
  FrozenContact out;
  structure_.elements->freeze_contact(y, tolerance, out);
  for (const NodeSpring& spring : structure_.node_springs)
    out.node_springs.push_back(!spring.law.one_sided ||
                               displacement(spring, y, small_displacements) - spring.law.gap > -tolerance);
  return out;
}

MovingZones StructuralProblem::moving_zones(const VectorXd& y, const VectorXd& rate) const {
  return structure_.elements->moving_zones(y, rate);
}

double StructuralProblem::missed_contact(const FrozenContact& frozen, const VectorXd& y) const {
  return structure_.elements->missed_contact(frozen, y);
}

FrozenContact StructuralProblem::freeze(const MovingZones& zones, const VectorXd& y) const {
  FrozenContact out;
  structure_.elements->freeze_zones(zones, y, out);
  for (const NodeSpring& spring : structure_.node_springs)
    out.node_springs.push_back(spring.acts(displacement(spring, y, false)));
  return out;
}

TouchingMarks StructuralProblem::marks_at(const VectorXd& y, bool small_displacements) const {
  const TouchingDistance near = touching_distance(y);
  TouchingMarks out;
  structure_.elements->mark_touching(y, near, out);
  for (const NodeSpring& spring : structure_.node_springs)
    out.node_springs.push_back(spring.law.one_sided &&
                               std::abs(displacement(spring, y, small_displacements) - spring.law.gap) <=
                                   near.of(spring.law.stiffness));
  return out;
}

std::size_t StructuralProblem::touching_springs(const TouchingMarks& marks) const {
  return static_cast<std::size_t>(std::count(marks.node_springs.begin(), marks.node_springs.end(), 1) +
                                  std::count(marks.element_springs.begin(), marks.element_springs.end(), 1));
}

void StructuralProblem::touching_displacements(const TouchingMarks& marks, const VectorXd& mode,
                                               std::vector<double>& out) const {
  out.clear();
  for (std::size_t i = 0; i < marks.node_springs.size(); ++i)
    if (marks.node_springs[i] != 0) out.push_back(structure_.node_springs[i].linear(mode));
  structure_.elements->touching_displacements(marks, mode, out);
}

void StructuralProblem::set_touching(const TouchingMarks& marks, const VectorXd& mode,
                                     std::span<const char> springs, FrozenContact& out) const {
  std::size_t next = 0;
  for (std::size_t i = 0; i < marks.node_springs.size(); ++i)
    if (marks.node_springs[i] != 0) out.node_springs[i] = springs[next++];
  structure_.elements->set_touching(marks, mode, springs.subspan(next), out);
}

TouchingSupports StructuralProblem::touching(const TouchingMarks& marks, const FrozenContact* frozen) const {
  const auto touch = [](bool acts) { return acts ? Touch::acts : Touch::absent; };
  TouchingSupports out;
  for (std::size_t i = 0; i < marks.node_springs.size(); ++i)
    if (marks.node_springs[i] != 0)
      out.springs.push_back(
          {structure_.node_springs[i].spring, touch(frozen != nullptr && frozen->node_springs[i] != 0)});
  for (const TouchingSpring& support : structure_.elements->touching_springs(marks, frozen))
    if (support.spring >= 0) out.springs.push_back({support.spring, touch(support.acts)});
  for (const TouchingContact& contact : structure_.elements->touching_contacts(marks, frozen)) {
    const MeshElement& cell = structure_.mesh.elements[contact.element];
    const auto add = [&](double from, double to, bool acts) {
      const double width = cell.to - cell.from;
      if (to - from > kOnePlace)
        out.foundations.push_back(
            {contact.foundation, {cell.from + from * width, cell.from + to * width}, touch(acts)});
    };
    double from = contact.range[0];
    for (const ElementPart& interval : contact.acting) {
      add(from, interval.from, false);
      add(interval.from, interval.to, true);
      from = interval.to;
    }
    add(from, contact.range[1], false);
  }
  return out;
}

double StructuralProblem::largest_axial_force(std::size_t member, const VectorXd& response) const {
  double force = 0.0;
  for (int e = structure_.mesh.first[member]; e < structure_.mesh.first[member + 1]; ++e)
    for (int q = 0; q < structure_.mesh.order; ++q)
      force = std::max(force, std::abs(response[structure_.dofs[e].s + q]));
  return force;
}

double StructuralProblem::least_force() const {
  return Rounding::force * (stage_ == Stage::proportional ? proportional_imposed_ : constant_imposed_);
}

double StructuralProblem::critical_load_scale(const VectorXd& unit_response) const {
  double scale = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < structure_.euler_loads.size(); ++m) {
    const double force = largest_axial_force(m, unit_response);
    if (force > least_force()) scale = std::min(scale, structure_.euler_loads[m] / force);
  }
  return scale;
}

double StructuralProblem::largest_critical_load_scale(const VectorXd& unit_response) const {
  double largest = 0.0;
  for (std::size_t m = 0; m < structure_.euler_loads.size(); ++m)
    largest = std::max(largest, largest_axial_force(m, unit_response));
  double scale = 0.0;
  for (std::size_t m = 0; m < structure_.euler_loads.size(); ++m) {
    const double force = largest_axial_force(m, unit_response);
    if (force > std::max(ProblemTolerances::small_axial_force * largest, least_force()))
      scale = std::max(scale, (structure_.euler_loads[m] + structure_.foundation_loads[m]) / force);
  }
  return scale;
}

double StructuralProblem::force_norm(const VectorXd& f) const {
  double forces = f.head(3 * structure_.nodes + structure_.releases).lpNorm<Eigen::Infinity>();
  for (const ElementDofs& dofs : structure_.dofs) {
    forces = std::max(forces, f.segment(dofs.v, 3 * structure_.mesh.order).lpNorm<Eigen::Infinity>());
    for (const int a : dofs.a) forces = std::max(forces, std::abs(f[a]));
  }
  return forces;
}

/// Largest force or moment of the loads with given factors on the undeformed structure.
double StructuralProblem::largest_load(const LoadFactors& factors) {
  VectorXd load =
      factors.proportional * structure_.proportional_load + factors.constant * structure_.constant_load;
  elements_->add_pressure_load(VectorXd::Zero(size()), factors, structure_.geometry == Geometry::linear,
                               load);
  return force_norm(load);
}

double StructuralProblem::largest_force(const VectorXd& y, double lambda) const {
  const auto [proportional, constant] = factors(lambda);
  double force = std::max(std::abs(proportional) * proportional_force_, std::abs(constant) * constant_force_);
  for (const ElementDofs& dofs : structure_.dofs)
    force = std::max(force, y.segment<3>(dofs.m).lpNorm<Eigen::Infinity>());
  return force;
}

/// Force scale of initial strains and prescribed displacements at a load factor: the smallest Euler load
/// times their displacement gradient. Needed where these actions meet no resistance and all forces are
/// rounding.
double StructuralProblem::imposed_force(double lambda) const {
  const auto [proportional, constant] = factors(lambda);
  return std::abs(proportional) * proportional_imposed_ + std::abs(constant) * constant_imposed_;
}

/// Denominator of the relative force residual (scaled): the largest section force, load or imposed_force().
double StructuralProblem::force_scale(const VectorXd& y, double lambda) const {
  return std::max(largest_force(y, lambda), imposed_force(lambda));
}

/// Relative residual that half a unit in the last place of the displacements leaves at the stiffest support.
double StructuralProblem::residual_rounding(const VectorXd& y, double lambda) const {
  double largest = std::max(elements_->support_rounding(), springs_.rounding(y));
  for (const JointSpring& joint : structure_.joints) {
    const double size = std::abs(y[joint.node_rotation]) + std::abs(y[joint.end_rotation]);
    largest = std::max(largest, joint.stiffness * size * std::numeric_limits<double>::epsilon());
  }
  const double force = force_scale(y, lambda);
  return force > 0.0 ? std::min(0.5 * largest / force, ProblemTolerances::most_rounding) : 0.0;
}

double StructuralProblem::relative_residual(const VectorXd& f, const VectorXd& y, double lambda) {
  const int p = structure_.mesh.order;
  const double force = force_scale(y, lambda);
  double displacement = 1.0;
  const double forces = force_norm(f);
  double gaps = 0.0;
  for (const ElementDofs& dofs : structure_.dofs) {
    gaps = std::max(gaps, f.segment(dofs.s, 3 * p + 3).lpNorm<Eigen::Infinity>());
    for (const int a : dofs.a) displacement = std::max(displacement, std::abs(y[a]));
  }
  for (int i = structure_.before_elements() - structure_.stops; i < structure_.before_elements(); ++i)
    gaps = std::max(gaps, std::abs(f[i]));
  return std::max(force > 0.0 ? forces / force : forces, gaps / displacement);
}

Eigen::MatrixXd StructuralProblem::find_products(const VectorXd& y, double lambda, const Regime& asked,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& directions) {
  end_if_asked(stop_);
  const Regime regime = regime_of(asked);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(y.size(), directions.cols());
  elements_->add_tangent_products(y, factors(lambda), regime, directions, products);
  springs_.evaluate(y, regime);
  for (Index i = 0; i < directions.cols(); ++i)
    add_node_products(y, lambda, regime, directions.col(i), products.col(i));
  return products;
}

/// Dead loads and constraints have constant tangents; the ends of pressed lines follow the load factor.
MatrixXd StructuralProblem::tangent_change(const VectorXd& y, double lambda, const PathDirection& along,
                                           const Eigen::Ref<const MatrixXd>& motions) {
  end_if_asked(stop_);
  MatrixXd change = MatrixXd::Zero(motions.rows(), motions.cols());
  const auto [proportional, constant] = factor_rates();
  const LoadFactors rates{along.lambda * proportional, along.lambda * constant};
  elements_->add_tangent_changes(y, rates, regime_of({}), along.y, motions, change);
  for (Index i = 0; i < change.cols(); ++i) {
    springs_.add_changes(y, structure_.geometry == Geometry::linear, along.y, motions.col(i), change.col(i));
    follower_loads_.add_change(y, factors(lambda), rates, along.y, motions.col(i), change.col(i));
    release_rows(change.col(i));
  }
  return change;
}

VectorXd StructuralProblem::load_change(const VectorXd& y, double, const PathDirection& along) {
  VectorXd change = VectorXd::Zero(y.size());
  if (structure_.geometry == Geometry::linear) return change;
  const auto [proportional, constant] = factor_rates();
  elements_->add_pressure_change({proportional, constant}, along.y, change);
  follower_loads_.add_product(y, {-proportional, -constant}, along.y, change);
  release_rows(change);
  return change;
}

void StructuralProblem::release_rows(Eigen::Ref<VectorXd> f) const {
  turn_to_supports(f);
  for (const Index row : fixed_)
    if (row < 3 * structure_.nodes) f[row] = 0.0;
}

/// Adds the tangent times `direction`, without the elements' part, in the row order of linearise().
void StructuralProblem::add_node_products(const VectorXd& y, double lambda, const Regime& regime,
                                          const Eigen::Ref<const VectorXd>& direction,
                                          Eigen::Ref<VectorXd> out) const {
  if (!regime.small_displacements) follower_loads_.add_product(y, factors(lambda), direction, out);
  springs_.add_products(direction, out);
  add_joint_moments(structure_, direction, out);
  if (holds_) {
    const Eigen::MatrixXd& H = holds_->motions;
    out.head(H.rows()) += holds_->stiffness * (H * (H.transpose() * direction.head(H.rows())));
  }
  turn_to_supports(out);
  for (int j = 0; j < structure_.nodes; ++j) {
    const auto [c, s] = turn_of(3 * j);
    const double local[3] = {c * direction[3 * j] + s * direction[3 * j + 1],
                             -s * direction[3 * j] + c * direction[3 * j + 1], direction[3 * j + 2]};
    for (int k = 0; k < 3; ++k)
      if (is_fixed(3 * j + k)) out[3 * j + k] = local[k];
  }
}

}  // namespace snapthrough
