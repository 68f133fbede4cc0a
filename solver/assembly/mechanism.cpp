#include "solver/assembly/mechanism.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <variant>

#include "solver/assembly/joined_supports.h"
#include "solver/assembly/structural_problem.h"

namespace snapthrough {
namespace {

/// Motions that are looked for, a factorisation each: eight bodies that nothing holds.
constexpr std::size_t kMostMotions = 24;
/// Displacement (over the structure's length) under forces of order one, where all stiffnesses are of order
/// one, that only a mechanism gives.
constexpr double kMechanismDisplacement = 1e9;

/// The same structure with all stiffnesses of one size: what can move without strain depends on the geometry
/// alone, and how far stiffnesses are apart says nothing of it.
/// @param one_sided whether supports that act on one side only are there (they count as glued)
Model of_equal_stiffness(const Model& model, bool one_sided) {
  Model out = with_joined_supports(model).value_or(model);
  out.monitors.clear();
  out.imperfections.clear();
  const Axes axes = make_axes(model);
  double length = 0.0;
  for (const auto& axis : axes) length = std::max(length, axis->length());
  const auto is_absent = [one_sided](const auto& support) {
    return support.stiffness == 0.0 || (!one_sided && support.reaction != Reaction::bilateral);
  };
  std::erase_if(out.springs, is_absent);
  std::erase_if(out.foundations, is_absent);
  constexpr double kAxial = 100.0;
  for (Section& section : out.sections) {
    section.EI = length * length;
    section.EA = kAxial;
    section.GA.reset();
  }
  for (Spring& spring : out.springs) spring.stiffness = spring.direction ? 1.0 / length : length;
  for (Foundation& base : out.foundations) {
    base.stiffness = 1.0 / (length * length);
    if (base.shear_stiffness > 0.0) base.shear_stiffness = 1.0;
  }
  return out;
}

Discretization coarse_mesh() {
  Discretization coarse;
  coarse.fixed_mesh = true;
  coarse.elements = 2;
  coarse.order = 2;
  return coarse;
}

/// Forces without pattern on all displacement unknowns: some part of them works on any motion.
Eigen::VectorXd scattered_forces(const Structure& structure) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(structure.size);
  unsigned state = 12345u;
  const auto next = [&state]() {
    state = state * 1664525u + 1013904223u;
    return 0.5 + static_cast<double>(state >> 8) / static_cast<double>(1u << 24);
  };
  for (Eigen::Index i = 0; i < 3 * structure.joints + structure.releases; ++i) forces[i] = next();
  for (const ElementDofs& dofs : structure.dofs)
    for (const int a : dofs.a)
      if (a >= 3 * structure.joints + structure.releases) forces[a] = next();
  for (int j = 0; j < structure.joints; ++j)  // rows of supports prescribe displacements: none
    for (int c = 0; c < 3; ++c)
      if (structure.supports[j].fixed[c]) forces[3 * j + c] = 0.0;
  return forces;
}

/// Length of a straight member or an arc; nothing for other curves.
std::optional<double> length_of(const Model& model, const Member& member) {
  const Node& a = model.nodes[index_of(model.nodes, member.start)];
  const Node& b = model.nodes[index_of(model.nodes, member.end)];
  const double chord = std::hypot(b.x - a.x, b.y - a.y);
  if (std::holds_alternative<LineCurve>(member.curve)) return chord;
  const auto* arc = std::get_if<ArcCurve>(&member.curve);
  if (arc == nullptr) return std::nullopt;
  const double half = 0.5 * std::abs(arc->sweep_degrees) * std::numbers::pi / 180.0;
  return chord * half / std::sin(half);
}

bool is_connected(const Model& model) {
  std::vector<std::size_t> group(model.nodes.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (const Member& member : model.members) {
    const std::size_t one = group[index_of(model.nodes, member.start)];
    const std::size_t other = group[index_of(model.nodes, member.end)];
    std::replace(group.begin(), group.end(), one, other);
  }
  return std::all_of(group.begin(), group.end(), [&](std::size_t g) { return g == group.front(); });
}

/// How firmly the supports hold a rigid body: the determinant of the sum of r r^T over the directions r
/// (force, force, moment by unit length) that they hold, over that of equal eigenvalues.
double firmness(const Model& model, double length) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const Node& origin = model.nodes.front();
  for (const Support& support : model.supports) {
    const Node& node = model.nodes[index_of(model.nodes, support.node)];
    const double angle = support.angle_degrees * std::numbers::pi / 180.0;
    const auto hold = [&](double dx, double dy) {
      const double moment = ((node.x - origin.x) * dy - (node.y - origin.y) * dx) / length;
      const Eigen::Vector3d row(dx, dy, moment);
      sum += row * row.transpose();
    };
    if (support.x) hold(std::cos(angle), std::sin(angle));
    if (support.y) hold(-std::sin(angle), std::cos(angle));
    if (support.rotation) sum(2, 2) += 1.0;
  }
  const double mean = sum.trace() / 3.0;
  return mean > 0.0 ? sum.determinant() / (mean * mean * mean) : 0.0;
}

}  // namespace

bool is_plainly_held(const Model& model) {
  constexpr std::size_t kFew = 10;
  constexpr double kComparable = 1e-3;
  constexpr double kFirm = 1e-3;
  if (model.members.size() > kFew || model.supports.empty()) return false;
  double length = 0.0;
  double least_EI = std::numeric_limits<double>::infinity();
  double largest_EI = 0.0;
  double least_force = least_EI;
  for (const Member& member : model.members) {
    const Section& section = model.sections[index_of(model.sections, member.section)];
    const std::optional<double> own = length_of(model, member);
    if (!own || member.release_start_rotation || member.release_end_rotation) return false;
    length = std::max(length, *own);
    least_EI = std::min(least_EI, section.EI);
    largest_EI = std::max(largest_EI, section.EI);
    least_force = std::min({least_force, section.EA, section.GA.value_or(section.EA)});
  }
  return least_EI >= kComparable * largest_EI &&
         least_force >= kComparable * largest_EI / (length * length) && is_connected(model) &&
         firmness(model, length) >= kFirm;
}

namespace {

/// A structure of equal stiffnesses and the motions that it does not resist.
class Mechanism {
 public:
  Mechanism(const Model& model, bool one_sided)
      : structure_(make_structure(of_equal_stiffness(model, one_sided), coarse_mesh(), Geometry::nonlinear)),
        problem_(structure_) {
    problem_.set_bonded(true);
    while (motions_.size() < kMostMotions && add_motion()) {
    }
  }

  /// One vector of all unknowns a motion.
  [[nodiscard]] const std::vector<Eigen::VectorXd>& motions() const { return motions_; }
  /// Over the joints' displacements, orthonormal columns.
  [[nodiscard]] const Eigen::MatrixXd& of_joints() const { return joints_; }
  /// The node that moves most.
  [[nodiscard]] std::size_t node_of(const Eigen::VectorXd& motion) const;
  /// Whether the actions of a kind do work on a motion of the unloaded structure.
  [[nodiscard]] bool drives(StructuralProblem::Stage stage, const Eigen::VectorXd& motion);

 private:
  [[nodiscard]] bool add_motion();

  Structure structure_;
  StructuralProblem problem_;
  std::vector<Eigen::VectorXd> motions_;
  Eigen::MatrixXd joints_;
};

/// Holds the structure against the motions found so far and looks for another; false when there is none.
bool Mechanism::add_motion() {
  const Eigen::Index rows = 3 * structure_.joints;
  if (joints_.cols() > 0)
    problem_.set_holds(std::make_shared<Holds>(Holds{joints_, Eigen::VectorXd::Zero(joints_.cols()), 1.0}));
  Eigen::VectorXd residual;
  problem_.linearise(Eigen::VectorXd::Zero(structure_.size), 0.0, residual);
  Eigen::VectorXd x = scattered_forces(structure_);
  problem_.solve(x);
  double largest = x.head(rows).lpNorm<Eigen::Infinity>();
  for (const ElementDofs& dofs : structure_.dofs)
    for (const int a : dofs.a) largest = std::max(largest, std::abs(x[a]));
  if (!(largest >= kMechanismDisplacement)) return false;
  // once more: what else the forces did is as much smaller as the motion was larger
  Eigen::VectorXd again;
  problem_.force_along(x.head(rows).normalized(), again);
  problem_.solve(again);
  Eigen::VectorXd moved = again.head(rows);
  for (int pass = 0; pass < 2 && joints_.cols() > 0; ++pass) moved -= joints_ * (joints_.transpose() * moved);
  const double size = moved.norm();
  motions_.push_back(again / size);
  joints_.conservativeResize(rows, joints_.cols() + 1);
  joints_.rightCols(1) = moved / size;
  return true;
}

std::size_t Mechanism::node_of(const Eigen::VectorXd& motion) const {
  int node = 0;
  for (int j = 1; j < structure_.joints; ++j)
    if (motion.segment<3>(3 * j).lpNorm<Eigen::Infinity>() >
        motion.segment<3>(3 * node).lpNorm<Eigen::Infinity>())
      node = j;
  return static_cast<std::size_t>(node);
}

bool Mechanism::drives(StructuralProblem::Stage stage, const Eigen::VectorXd& motion) {
  constexpr double kRounding = 1e-9;
  Eigen::VectorXd load;
  problem_.set_stage(stage);
  problem_.load(Eigen::VectorXd::Zero(structure_.size), 0.0, load);
  return std::abs(load.dot(motion)) > kRounding * load.lpNorm<1>() * motion.lpNorm<Eigen::Infinity>();
}

}  // namespace

bool can_move(const Model& model) { return !Mechanism(model, true).motions().empty(); }

Eigen::MatrixXd free_motions(const Model& model) {
  return is_plainly_held(model) ? Eigen::MatrixXd() : Mechanism(model, false).of_joints();
}

std::vector<Finding> find_mechanism(const Model& model) {
  if (is_plainly_held(model)) return {};
  Mechanism mechanism(model, true);
  if (mechanism.motions().size() == kMostMotions)
    return {{"/model/supports", "mechanism",
             "supports and bases leave at least " + std::to_string(kMostMotions) +
                 " motions without strain: more than an analysis can hold"}};
  for (const Eigen::VectorXd& motion : mechanism.motions()) {
    if (!mechanism.drives(StructuralProblem::Stage::proportional, motion) &&
        !mechanism.drives(StructuralProblem::Stage::constant, motion))
      continue;
    return {
        {"/model/supports", "mechanism",
         "the loads can move the structure without strain (supports and bases do not hold it; the motion is "
         "largest near node \"" +
             model.nodes[mechanism.node_of(motion)].id + "\")"}};
  }
  return {};
}

}  // namespace snapthrough
