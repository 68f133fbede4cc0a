#include "solver/discrete/mechanism.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "solver/discrete/rigid_parts.h"
#include "solver/mesh/mesh.h"
#include "solver/model/id_index.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/null_space.h"
#include "solver/support/joined_supports.h"

namespace snapthrough {
namespace {

/// Motions that are looked for: eight bodies that nothing holds.
constexpr std::size_t kMostMotions = 24;
/// Sine of an angle below which two directions are one: three hinges this near to a line can move, and so can
/// a body whose supports' lines of action pass this near to one point.
constexpr double kOneDirection = 1e-6;

using Row = RigidParts::Row;

/// What the supports, springs and foundations of a model hold: their stiffnesses say nothing of what can move
/// without strain.
class Holding {
 public:
  /// @param one_sided whether supports that act on one side only are there (they count as glued)
  Holding(const RigidParts& parts, bool one_sided) : parts_(parts), one_sided_(one_sided) {
    for (const Support& support : parts.model().supports) add(support);
    for (const Spring& spring : parts.model().springs)
      if (is_there(spring)) add(spring);
    for (const Foundation& foundation : parts.model().foundations)
      if (is_there(foundation)) add(foundation);
  }

  /// Rows that are zero in a motion that meets no support.
  std::vector<Row> held;
  /// Displacements of the places that are held.
  std::vector<Row> moved;

 private:
  template <class Support>
  [[nodiscard]] bool is_there(const Support& support) const {
    return support.stiffness > 0.0 && (one_sided_ || support.reaction == Reaction::bilateral);
  }
  void add(const Support& support);
  void add(const Spring& spring);
  void add(const Foundation& foundation);
  void hold(const Row& rotation, double radius);
  void hold(int node, double x, double y);
  void hold(int member, RigidParts::Point at, double x, double y);

  const RigidParts& parts_;
  bool one_sided_;
};

void Holding::hold(const Row& rotation, double radius) {
  held.push_back(rotation);
  for (auto& [unknown, weight] : held.back()) weight *= radius;
}

void Holding::hold(int node, double x, double y) {
  const double size = std::hypot(x, y);
  held.push_back(parts_.displacement(node, {x / size, y / size}));
  moved.push_back(parts_.displacement(node, {1.0, 0.0}));
  moved.push_back(parts_.displacement(node, {0.0, 1.0}));
}

void Holding::hold(int member, RigidParts::Point at, double x, double y) {
  const double size = std::hypot(x, y);
  held.push_back(parts_.displacement(member, at, {x / size, y / size}));
  moved.push_back(parts_.displacement(member, at, {1.0, 0.0}));
  moved.push_back(parts_.displacement(member, at, {0.0, 1.0}));
}

void Holding::add(const Support& support) {
  const int node = parts_.node(support.node);
  const double angle = support.angle_degrees * std::numbers::pi / 180.0;
  if (support.x) hold(node, std::cos(angle), std::sin(angle));
  if (support.y) hold(node, -std::sin(angle), std::cos(angle));
  if (support.rotation) hold(parts_.node_rotation(node), parts_.node_radius(node));
}

void Holding::add(const Spring& spring) {
  if (!spring.at.node.empty()) {
    const int node = parts_.node(spring.at.node);
    if (spring.direction)
      hold(node, (*spring.direction)[0], (*spring.direction)[1]);
    else
      hold(parts_.node_rotation(node), parts_.node_radius(node));
    return;
  }
  const int member = parts_.member(spring.at.member);
  const AxisPoint at = parts_.place(member, spring.at.fraction);
  if (spring.direction)
    hold(member, {at.x, at.y}, (*spring.direction)[0], (*spring.direction)[1]);
  else
    hold(parts_.rotation(member), parts_.radius(member));
}

/// A foundation holds every point of its range; on a straight axis two points tell of all. The shear layer
/// holds the derivative of the displacement n.u along the axis: n'.u and the rotation of its direction.
void Holding::add(const Foundation& foundation) {
  const int member = parts_.member(foundation.member);
  const bool straight = parts_.axes()[static_cast<std::size_t>(member)]->straight();
  const Quadrature points = gauss_legendre(straight ? 2 : 6);
  for (const double point : points.points) {
    const AxisPoint at =
        parts_.place(member, foundation.range[0] + point * (foundation.range[1] - foundation.range[0]));
    const double c = std::cos(at.angle);
    const double s = std::sin(at.angle);
    const auto [x, y] = foundation.direction.value_or(RigidParts::Point{-s, c});
    hold(member, {at.x, at.y}, x, y);
    if (!(foundation.shear_stiffness > 0.0)) continue;
    const double turn = foundation.direction ? 0.0 : -at.curvature;
    Row row = parts_.displacement(member, {at.x, at.y}, {turn * c, turn * s});
    for (const auto& [unknown, weight] : parts_.rotation(member))
      row.emplace_back(unknown, weight * (y * c - x * s) / std::hypot(x, y) * parts_.radius(member));
    held.push_back(std::move(row));
  }
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

/// Work of the loads of one pattern on the motions of rigid parts. Initial strains do none, nor do prescribed
/// displacements: what they hold doesn't move.
class Loading {
 public:
  Loading(const RigidParts& parts, Pattern pattern)
      : parts_(parts), pattern_(pattern), forces_(Eigen::VectorXd::Zero(parts.unknowns())) {
    for (const Load& load : parts.model().loads) std::visit([this](const auto& l) { add(l); }, load);
  }

  /// By unknown.
  [[nodiscard]] const Eigen::VectorXd& forces() const { return forces_; }
  /// Sum of all forces' sizes.
  [[nodiscard]] double size() const { return size_; }

 private:
  void add(const PointLoad& load);
  void add(const DistributedLoad& load);
  void add(const PressureLoad& load);
  void add(const InitialStrain&) {}
  void add(const Row& row, double force) {
    size_ += std::abs(force);
    for (const auto& [unknown, weight] : row) forces_[unknown] += force * weight;
  }
  void add(int member, RigidParts::Point at, double x, double y) {
    add(parts_.displacement(member, at, {1.0, 0.0}), x);
    add(parts_.displacement(member, at, {0.0, 1.0}), y);
  }

  const RigidParts& parts_;
  Pattern pattern_;
  Eigen::VectorXd forces_;
  double size_ = 0.0;
};

void Loading::add(const PointLoad& load) {
  if (load.pattern != pattern_) return;
  const double moment = load.moment / parts_.length();
  if (!load.at.node.empty()) {
    const int node = parts_.node(load.at.node);
    add(parts_.displacement(node, {1.0, 0.0}), load.force[0]);
    add(parts_.displacement(node, {0.0, 1.0}), load.force[1]);
    add(parts_.node_rotation(node), moment);
    return;
  }
  const int member = parts_.member(load.at.member);
  const AxisPoint at = parts_.place(member, load.at.fraction);
  add(member, {at.x, at.y}, load.force[0], load.force[1]);
  add(parts_.rotation(member), moment);
}

void Loading::add(const DistributedLoad& load) {
  if (load.pattern != pattern_) return;
  const int member = parts_.member(load.member);
  const AxisCurve& axis = *parts_.axes()[static_cast<std::size_t>(member)];
  const Quadrature gauss = gauss_legendre(axis.straight() ? 2 : 8);
  const int pieces = axis.straight() ? 1 : 4;
  const double width = (load.range[1] - load.range[0]) / pieces;
  for (int piece = 0; piece < pieces; ++piece) {
    for (std::size_t i = 0; i < gauss.points.size(); ++i) {
      const AxisPoint at = parts_.place(member, load.range[0] + width * (piece + gauss.points[i]));
      double w = axis.length() * width * gauss.weights[i];
      if (load.per == LoadMeasure::horizontal) w *= std::abs(std::cos(at.angle));
      if (load.per == LoadMeasure::vertical) w *= std::abs(std::sin(at.angle));
      add(member, {at.x, at.y}, w * load.force[0], w * load.force[1]);
    }
  }
}

/// With the right normal n = (t_y, -t_x), int n ds is the chord turned by -90 degrees, and the moment about
/// the start int (x - x_a) x n ds = -|x_b - x_a|^2 / 2: pressure acts as if on the chord.
void Loading::add(const PressureLoad& load) {
  if (load.pattern != pattern_) return;
  const int member = parts_.member(load.member);
  const AxisPoint a = parts_.place(member, 0.0);
  const AxisPoint b = parts_.place(member, 1.0);
  const double force = (load.side == Side::left ? 1.0 : -1.0) * load.value * parts_.length();
  add(member, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, force * (b.y - a.y), -force * (b.x - a.x));
}

/// The motions that a structure does not resist.
class Mechanism {
 public:
  /// @param one_sided as in Holding
  Mechanism(const Model& model, bool one_sided);

  /// One vector of the rigid parts' unknowns a motion, orthonormal.
  [[nodiscard]] const std::vector<Eigen::VectorXd>& motions() const { return motions_; }
  /// Whether the parts are connected in too many ways to tell.
  [[nodiscard]] bool unknown() const { return unknown_; }
  /// Displacements of the nodes (x, y, rotation each).
  [[nodiscard]] Eigen::VectorXd of_nodes(const Eigen::VectorXd& motion) const;
  /// The node that moves most.
  [[nodiscard]] std::size_t node_of(const Eigen::VectorXd& motion) const;
  /// The motion on which the loads of a pattern do work, if they do on any.
  [[nodiscard]] std::optional<Eigen::VectorXd> driven_by(Pattern pattern) const;

 private:
  RigidParts parts_;
  std::vector<Eigen::VectorXd> motions_;
  bool unknown_ = false;
};

Mechanism::Mechanism(const Model& model, bool one_sided) : parts_(model) {
  Holding holding(parts_, one_sided);
  std::vector<Row> rows = parts_.joints();
  rows.insert(rows.end(), holding.held.begin(), holding.held.end());
  std::vector<Row> sizes = parts_.turns();
  sizes.insert(sizes.end(), holding.moved.begin(), holding.moved.end());
  NullSpace space(matrix_of(rows, parts_.unknowns()), matrix_of(sizes, parts_.unknowns()), kOneDirection);
  unknown_ = space.too_dense();
  while (motions_.size() < kMostMotions) {
    std::optional<Eigen::VectorXd> motion = space.next();
    if (!motion) break;
    motions_.push_back(std::move(*motion));
  }
}

Eigen::VectorXd Mechanism::of_nodes(const Eigen::VectorXd& motion) const {
  const auto value = [&motion](const Row& row) {
    double sum = 0.0;
    for (const auto& [unknown, weight] : row) sum += weight * motion[unknown];
    return sum;
  };
  const auto nodes = static_cast<int>(parts_.model().nodes.size());
  Eigen::VectorXd out(3 * nodes);
  for (int j = 0; j < nodes; ++j)
    out.segment<3>(3 * j) << value(parts_.displacement(j, {1.0, 0.0})),
        value(parts_.displacement(j, {0.0, 1.0})), value(parts_.node_rotation(j));
  return out;
}

std::size_t Mechanism::node_of(const Eigen::VectorXd& motion) const {
  constexpr double kMore = 1.0 + 1e-9;  // of those that move alike the first, whatever rounding says
  const Eigen::VectorXd moved = of_nodes(motion);
  Eigen::Index node = 0;
  for (Eigen::Index j = 1; 3 * j < moved.size(); ++j)
    if (moved.segment<3>(3 * j).lpNorm<Eigen::Infinity>() >
        kMore * moved.segment<3>(3 * node).lpNorm<Eigen::Infinity>())
      node = j;
  return static_cast<std::size_t>(node);
}

std::optional<Eigen::VectorXd> Mechanism::driven_by(Pattern pattern) const {
  constexpr double kRounding = 1e-9;
  const Loading loading(parts_, pattern);
  Eigen::VectorXd driven = Eigen::VectorXd::Zero(parts_.unknowns());
  for (const Eigen::VectorXd& motion : motions_) driven += loading.forces().dot(motion) * motion;
  const double work = driven.norm();  // on the motion of length one
  if (work == 0.0) return std::nullopt;
  driven /= work;
  if (!(work > kRounding * loading.size() * of_nodes(driven).lpNorm<Eigen::Infinity>())) return std::nullopt;
  return driven;
}

}  // namespace

bool can_move(const Model& model) { return !Mechanism(model, true).motions().empty(); }

Eigen::MatrixXd free_motions(const Model& model) {
  if (is_plainly_held(model)) return {};
  // opposite one-sided supports act as one of both sides and hold
  const std::optional<Model> joined = with_joined_supports(model);
  const Mechanism mechanism(joined ? *joined : model, false);
  if (mechanism.motions().empty()) return {};
  const auto count = static_cast<Eigen::Index>(mechanism.motions().size());
  Eigen::MatrixXd nodes(3 * static_cast<Eigen::Index>(model.nodes.size()), count);
  for (Eigen::Index i = 0; i < count; ++i)
    nodes.col(i) = mechanism.of_nodes(mechanism.motions()[static_cast<std::size_t>(i)]);
  const Eigen::HouseholderQR<Eigen::MatrixXd> orthonormal(nodes);
  const Eigen::MatrixXd motions = orthonormal.householderQ() * Eigen::MatrixXd::Identity(nodes.rows(), count);
  // what rounding left where nothing moves would couple parts that have nothing to do with one another
  constexpr double kRounding = 1e-14;
  return (motions.array().abs() > kRounding).select(motions, 0.0);
}

std::vector<Finding> find_mechanism(const Model& model) {
  if (is_plainly_held(model)) return {};
  const Mechanism mechanism(model, true);
  if (mechanism.unknown())
    return {
        {"/model/members", "too_connected",
         "these members connect far nodes in so many ways that their equations fill up: neither whether the "
         "structure can move nor what it does under load can be computed in reasonable time"}};
  if (mechanism.motions().empty()) return {};
  if (mechanism.motions().size() == kMostMotions)
    return {{"/model/supports", "mechanism",
             "supports and foundations leave at least " + std::to_string(kMostMotions) +
                 " motions without strain: more than an analysis can hold"}};
  std::optional<Eigen::VectorXd> motion = mechanism.driven_by(Pattern::proportional);
  if (!motion) motion = mechanism.driven_by(Pattern::constant);
  if (!motion) return {};
  return {{"/model/supports", "mechanism",
           "the loads can move the structure without strain (supports and foundations do not hold it; the "
           "motion is "
           "largest near node \"" +
               model.nodes[mechanism.node_of(*motion)].id + "\")"}};
}

}  // namespace snapthrough
