#include "tests/stress/rod_tangent.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace snapthrough::testing {
namespace {

using Eigen::Index;

/// Pressure on an element at a load factor.
RodPressure pressure_at(const RodElement& element, double load_factor) {
  return {load_factor * element.pressure[0].from + element.pressure[1].from,
          load_factor * element.pressure[0].to + element.pressure[1].to};
}

/// Variations are written in the nodes' displacements and every Gauss point's strains: those of the section
/// in units that make its elastic energy |strain|^2 / 2 exactly, so nothing is large where a section is
/// stiff, and an unshearable section has no shear strain at all.
class MemberTangent {
 public:
  MemberTangent(const RodModel& rod, const RodState& at, int member, double load_factor)
      : rod_(rod), at_(at), member_(member), load_factor_(load_factor) {
    const RodElement& first = rod.elements[rod.mesh.first[member]];
    shearable_ = first.shears;
    per_element_ = rod.lagrange.order() * (shearable_ ? 3 : 2);
    size_ = 3 + per_element_ * (rod.mesh.first[member + 1] - rod.mesh.first[member]);
    H_ = MatrixXd::Zero(size_, size_);
    H_.diagonal().tail(size_ - 3).setOnes();
    rest_ = MatrixXd::Zero(size_, size_);
    end_ = MatrixXd::Zero(3, size_);
    end_.leftCols(3).setIdentity();
  }
  void build() {
    for (int e = rod_.mesh.first[member_]; e < rod_.mesh.first[member_ + 1]; ++e) add_element(e);
  }
  [[nodiscard]] const MatrixXd& hessian() const { return H_; }
  [[nodiscard]] const MatrixXd& rest() const { return rest_; }  ///< antisymmetric part
  [[nodiscard]] const MatrixXd& end() const { return end_; }    ///< displacement of the member's end

 private:
  void add_element(int e);
  void add_supports(const ElementState& at, const std::array<MatrixXd, 3>& v);
  void add_pressure(const RodElement& element, const std::array<MatrixXd, 3>& v);

  const RodModel& rod_;
  const RodState& at_;
  int member_;
  double load_factor_;
  bool shearable_ = false;
  Index per_element_ = 0, size_ = 0;
  MatrixXd H_, rest_, end_;
};

void MemberTangent::add_element(int e) {
  const RodElement& element = rod_.elements[e];
  const ElementState& at = at_.elements[e];
  const Index p = rod_.lagrange.order();
  const Index first = 3 + per_element_ * (e - rod_.mesh.first[member_]);
  const auto& b = rod_.lagrange.rule().weights;
  const auto unit = [&](Index q, double c) { return std::sqrt(c * element.stretch[q] / (element.h * b[q])); };
  std::array<MatrixXd, 3> v;  // rows of du'_q
  v.fill(MatrixXd::Zero(p, size_));
  for (Index q = 0; q < p; ++q) v[2](q, first + per_element_ - p + q) = unit(q, at.bending[q]);
  MatrixXd turns(p, size_);
  VectorXd weight(p);
  for (Index q = 0; q < p; ++q) {
    const VectorXd a = element.h * rod_.lagrange.integrals(rod_.lagrange.rule().points[q]);
    turns.row(q) = end_.row(2) + a.transpose() * v[2];
    const double de = unit(q, element.axial[q]);
    const double dg = shearable_ ? unit(q, element.shear[q]) : 0.0;
    Eigen::RowVectorXd along = -at.G[q] * turns.row(q);
    Eigen::RowVectorXd across = at.E[q] * turns.row(q);
    along[first + q] += de;
    if (shearable_) across[first + p + q] += dg;
    v[0].row(q) = at.cos[q] * along - at.sin[q] * across;
    v[1].row(q) = at.sin[q] * along + at.cos[q] * across;
    // second derivatives of the strains: e'' = 2 db dg + E db^2, g'' = -2 db de + G db^2
    const double hb = element.h * b[q];
    weight[q] = hb * (at.N[q] * at.E[q] + at.Q[q] * at.G[q]);
    const auto cross = [&](Index column, double factor) {
      H_.col(column) += factor * turns.row(q).transpose();
      H_.row(column) += factor * turns.row(q);
    };
    cross(first + q, -hb * at.Q[q] * de);
    if (shearable_) cross(first + p + q, hb * at.N[q] * dg);
  }
  H_ += turns.transpose() * weight.asDiagonal() * turns;
  add_supports(at, v);
  add_pressure(element, v);
  for (int c = 0; c < 3; ++c)
    for (Index q = 0; q < p; ++q) end_.row(c) += element.h * b[q] * v[c].row(q);
}

/// The stiffness of all supports in u_a and u'_q first, which are fewer than points of quadrature.
void MemberTangent::add_supports(const ElementState& at, const std::array<MatrixXd, 3>& v) {
  if (at.acting.empty()) return;
  const Index p = rod_.lagrange.order();
  MatrixXd rows(3 * (p + 1), size_);
  rows.topRows(3) = end_;
  for (Index c = 0; c < 3; ++c) rows.middleRows(3 + c * p, p) = v[static_cast<std::size_t>(c)];
  MatrixXd stiffness = MatrixXd::Zero(rows.rows(), rows.rows());
  VectorXd row(rows.rows());
  for (const ActingSupport& support : at.acting) {
    row.head(3) = support.row.a;
    for (Index c = 0; c < 3; ++c) row.segment(3 + c * p, p) = support.row.v.row(c).transpose();
    stiffness += support.stiffness * row * row.transpose();
  }
  H_ += rows.transpose() * (stiffness * rows);
}

/// Adds the tangent of a follower pressure: its symmetric part, and the skew part where the pressure varies.
void MemberTangent::add_pressure(const RodElement& element, const std::array<MatrixXd, 3>& v) {
  const RodPressure pressure = pressure_at(element, load_factor_);
  if (pressure.from == 0.0 && pressure.to == 0.0) return;
  const Rule& rule = rod_.lagrange.rule();
  for (Index q = 0; q < rod_.lagrange.order(); ++q) {
    const VectorXd a = element.h * rod_.lagrange.integrals(rule.points[q]);
    const double w = 0.5 * pressure.at(rule.points[q]) * element.h * rule.weights[q];
    const Eigen::RowVectorXd ux = end_.row(0) + a.transpose() * v[0];
    const Eigen::RowVectorXd uy = end_.row(1) + a.transpose() * v[1];
    const MatrixXd half = -w * (v[1].row(q).transpose() * ux - v[0].row(q).transpose() * uy);
    H_ += half + half.transpose();
    if (pressure.from == pressure.to) continue;
    const double change = 0.5 * rule.weights[q] * (pressure.to - pressure.from);
    rest_ += change * (ux.transpose() * uy - uy.transpose() * ux);
  }
}

/// Adds the stiffness of a joint between two rotations.
void add_joint(MatrixXd& K, double stiffness, Index end, Index node) {
  K(end, end) += stiffness;
  K(node, node) += stiffness;
  K(end, node) -= stiffness;
  K(node, end) -= stiffness;
}

/// Adds the tangent of a rod or cable.
void add_bar(MatrixXd& K, const RodBar& bar, const RodState& at, double load_factor) {
  const Eigen::Vector2d now = bar.along + (at.nodes[bar.end] - at.nodes[bar.start]).head<2>();
  const Eigen::Matrix2d k = bar.pull(now, load_factor).tangent;
  for (const int row : {bar.start, bar.end})
    for (const int column : {bar.start, bar.end})
      K.block(3L * row, 3L * column, 2, 2) += row == column ? k : Eigen::Matrix2d(-k);
}

/// Adds the tangent of a spring, at its node and at its other end.
void add_node_spring(MatrixXd& K, const NodeSpring& spring, double stiffness) {
  const Eigen::Matrix3d k = stiffness * spring.row * spring.row.transpose();
  K.block(3L * spring.node, 3L * spring.node, 3, 3) += k;
  if (spring.to < 0) return;
  K.block(3L * spring.to, 3L * spring.to, 3, 3) += k;
  K.block(3L * spring.node, 3L * spring.to, 3, 3) -= k;
  K.block(3L * spring.to, 3L * spring.node, 3, 3) -= k;
}

/// Rows of the displacements of members' ends.
struct EndRows {
  const std::vector<std::array<Index, 3>>&start, &end;
};

/// Adds springs at nodes, joints, and what follower pressures leave at members' ends.
void add_end_actions(const RodModel& rod, const RodState& at, double load_factor, const EndRows& rows,
                     ConstrainedTangent& out) {
  MatrixXd& K = out.matrix;
  for (std::size_t i = 0; i < rod.node_springs.size(); ++i)
    add_node_spring(K, rod.node_springs[i], at.node_stiffness[i]);
  for (const RodBar& bar : rod.bars) add_bar(K, bar, at, load_factor);
  for (std::size_t m = 0; m < rod.members.size(); ++m) {
    const RodMember& member = rod.members[m];
    if (member.at_start.resists)
      add_joint(K, at.joint_stiffness[m][0], rows.start[m][2], 3L * member.start + 2);
    if (member.at_end.resists) add_joint(K, at.joint_stiffness[m][1], rows.end[m][2], 3L * member.end + 2);
    const double first = pressure_at(rod.elements[rod.mesh.first[m]], load_factor).from;
    const double last = pressure_at(rod.elements[rod.mesh.first[m + 1] - 1], load_factor).to;
    for (const auto& [node, half] :
         {std::pair{rows.start[m], -0.5 * first}, std::pair{rows.end[m], 0.5 * last}}) {
      out.rest(node[0], node[1]) -= half;
      out.rest(node[1], node[0]) += half;
    }
  }
}

}  // namespace

int tangent_size(const RodModel& rod) {
  auto size = static_cast<int>(3 * rod.nodes.size() + 5 * rod.members.size());
  for (const RodNode& node : rod.nodes) size += static_cast<int>(std::ranges::count(node.fixed, true));
  for (const RodElement& e : rod.elements) size += rod.lagrange.order() * (e.shears ? 3 : 2);
  return size;
}

ConstrainedTangent tangent_of(const RodModel& rod, const RodState& at, double load_factor) {
  const auto nodes = static_cast<Index>(3 * rod.nodes.size());
  Index free = nodes;
  Index constraints = static_cast<Index>(3 * rod.members.size());
  for (const RodNode& node : rod.nodes) constraints += std::ranges::count(node.fixed, true);
  std::vector<MemberTangent> members;
  std::vector<std::array<Index, 3>> start, end;
  std::vector<Index> strains;
  for (std::size_t m = 0; m < rod.members.size(); ++m) {
    const RodMember& member = rod.members[m];
    start.push_back({3L * member.start, 3L * member.start + 1, 3L * member.start + 2});
    end.push_back({3L * member.end, 3L * member.end + 1, 3L * member.end + 2});
    if (member.at_start.turns) start.back()[2] = free++;
    if (member.at_end.turns) end.back()[2] = free++;
    members.emplace_back(rod, at, static_cast<int>(m), load_factor);
    members.back().build();
    strains.push_back(free);
    free += members.back().hessian().rows() - 3;
  }
  ConstrainedTangent out;
  out.constraints = static_cast<int>(constraints);
  out.matrix = MatrixXd::Zero(free + constraints, free + constraints);
  out.rest = out.matrix;
  MatrixXd& K = out.matrix;
  Index row = free;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const MatrixXd& H = members[m].hessian();
    const auto place = [&](Index i) { return i < 3 ? start[m][i] : strains[m] + i - 3; };
    for (Index i = 0; i < H.rows(); ++i)
      for (Index j = 0; j < H.rows(); ++j) {
        K(place(i), place(j)) += H(i, j);
        out.rest(place(i), place(j)) += members[m].rest()(i, j);
      }
    for (int c = 0; c < 3; ++c, ++row) {
      for (Index j = 0; j < H.rows(); ++j) K(row, place(j)) += members[m].end()(c, j);
      K(row, end[m][c]) -= 1.0;
    }
  }
  for (std::size_t n = 0; n < rod.nodes.size(); ++n) {
    const double c = std::cos(rod.nodes[n].angle);
    const double s = std::sin(rod.nodes[n].angle);
    const Eigen::Matrix3d turn = (Eigen::Matrix3d() << c, s, 0, -s, c, 0, 0, 0, 1).finished();
    for (int k = 0; k < 3; ++k)
      if (rod.nodes[n].fixed[k]) K.block(row++, static_cast<Index>(3 * n), 1, 3) = turn.row(k);
  }
  add_end_actions(rod, at, load_factor, {start, end}, out);
  // the rotation of a node all of whose members are hinged is no displacement of the structure
  for (Index i = 2; i < nodes; i += 3)
    if (K.col(i).isZero(0.0)) K(i, i) = 1.0;
  const MatrixXd upper = K.bottomLeftCorner(constraints, free).transpose();
  K.topRightCorner(free, constraints) = upper;
  return out;
}

}  // namespace snapthrough::testing
