#include "solver/discrete/rigid_parts.h"
#include "solver/geometry/axes.h"
#include "solver/mesh/dof_map.h"
#include "solver/resolve/rods.h"
#include "solver/support/law.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace snapthrough {
namespace {

/// Root of a disjoint-set forest, with path halving.
int root_of(std::vector<int>& parent, int i) {
  const auto at = [&parent](int k) -> int& { return parent[static_cast<std::size_t>(k)]; };
  while (at(i) != i) {
    at(i) = at(at(i));
    i = at(i);
  }
  return i;
}

void append(RigidParts::Row& row, const RigidParts::Row& other, double factor) {
  for (const auto& [unknown, weight] : other) row.emplace_back(unknown, factor * weight);
}

}  // namespace

RigidParts::RigidParts(const ResolvedModel& model) : model_(model), axes_(make_axes(model)) {
  for (const auto& axis : axes_) length_ = std::max(length_, axis->length());
  if (axes_.empty()) length_ = longest_rod(model.springs);
  const Node& origin = model.nodes.front();
  for (const Node& node : model.nodes)
    nodes_.push_back({(node.x - origin.x) / length_, (node.y - origin.y) / length_});
  for (const ResolvedMember& member : model.members) ends_.push_back({member.start, member.end});
  find_bodies();
  place_bodies();
  number_nodes();
}

/// Finds the bodies: connected components of the graph of node rotations and unreleased member ends.
void RigidParts::find_bodies() {
  std::vector<int> parent(nodes_.size());
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<char> turned(nodes_.size(), 0);  // true: some member is not released there
  for (std::size_t m = 0; m < ends_.size(); ++m) {
    const ResolvedMember& member = model_.members[m];
    if (!is_hinged_at_start(member)) turned[ends_[m][0]] = 1;
    if (!is_hinged_at_end(member)) turned[ends_[m][1]] = 1;
    if (!is_hinged_at_start(member) && !is_hinged_at_end(member))
      parent[root_of(parent, ends_[m][0])] = root_of(parent, ends_[m][1]);
  }
  std::vector<int> body_of_root(nodes_.size(), -1);
  turns_with_.assign(nodes_.size(), -1);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (turned[n] == 0) continue;
    int& body = body_of_root[root_of(parent, static_cast<int>(n))];
    if (body < 0) {
      body = static_cast<int>(bodies_.size());
      bodies_.push_back({DofMap::first(body), {}, 0.0});
    }
    turns_with_[n] = body;
  }
  for (std::size_t m = 0; m < ends_.size(); ++m) {
    const ResolvedMember& member = model_.members[m];
    body_of_member_.push_back(!is_hinged_at_start(member) ? turns_with_[ends_[m][0]]
                              : !is_hinged_at_end(member) ? turns_with_[ends_[m][1]]
                                                          : -1);
  }
}

/// Sets the middle of each body to the mean of its members' end nodes, its radius to the largest distance.
void RigidParts::place_bodies() {
  std::vector<double> count(bodies_.size(), 0.0);
  for (std::size_t m = 0; m < ends_.size(); ++m) {
    if (body_of_member_[m] < 0) continue;
    for (const int node : ends_[m]) {
      for (int c = 0; c < 2; ++c) bodies_[body_of_member_[m]].middle[c] += nodes_[node][c];
      count[body_of_member_[m]] += 1.0;
    }
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (double& c : bodies_[b].middle) c /= count[b];
  for (std::size_t m = 0; m < ends_.size(); ++m) {
    if (body_of_member_[m] < 0) continue;
    Body& body = bodies_[body_of_member_[m]];
    for (const int node : ends_[m])
      body.radius = std::max(body.radius,
                             std::hypot(nodes_[node][0] - body.middle[0], nodes_[node][1] - body.middle[1]));
  }
}

/// Assigns each node to the body whose rotation it shares, or else to the first body hinged there.
void RigidParts::number_nodes() {
  moves_with_ = turns_with_;
  for (std::size_t m = 0; m < ends_.size(); ++m)
    for (const int node : ends_[m])
      if (moves_with_[node] < 0) moves_with_[node] = body_of_member_[m];
  unknowns_ = DofMap::count(static_cast<int>(bodies_.size()));
  first_of_node_.assign(nodes_.size(), -1);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (moves_with_[n] >= 0) continue;
    first_of_node_[n] = unknowns_;
    unknowns_ += 2;
  }
}

AxisPoint RigidParts::place(int member, double fraction) const {
  const AxisCurve& axis = *axes_[static_cast<std::size_t>(member)];
  AxisPoint at = axis.at(fraction * axis.length());
  at.x /= length_;
  at.y /= length_;
  at.curvature *= length_;
  return at;
}

RigidParts::Row RigidParts::of_body(int body, Point at, Point direction) const {
  const Body& b = bodies_[static_cast<std::size_t>(body)];
  const double lever = (at[0] - b.middle[0]) * direction[1] - (at[1] - b.middle[1]) * direction[0];
  return {{b.first, direction[0]}, {b.first + 1, direction[1]}, {b.first + 2, lever / b.radius}};
}

RigidParts::Bar RigidParts::bar(int member) const {
  const auto [start, end] = ends_[static_cast<std::size_t>(member)];
  return {start, end, {nodes_[end][0] - nodes_[start][0], nodes_[end][1] - nodes_[start][1]}};
}

RigidParts::Row RigidParts::displacement(int node, Point direction) const {
  const int body = moves_with_[static_cast<std::size_t>(node)];
  if (body >= 0) return of_body(body, place(node), direction);
  const int first = first_of_node_[static_cast<std::size_t>(node)];
  return {{first, direction[0]}, {first + 1, direction[1]}};
}

RigidParts::Row RigidParts::displacement(int member, Point at, Point direction) const {
  const int body = body_of_member_[static_cast<std::size_t>(member)];
  if (body >= 0) return of_body(body, at, direction);
  const Bar b = bar(member);
  const Point start = place(b.start);
  Row row = displacement(b.start, direction);
  append(row, rotation(member), (at[0] - start[0]) * direction[1] - (at[1] - start[1]) * direction[0]);
  return row;
}

RigidParts::Row RigidParts::displacement(const ResolvedLocation& at, Point direction) const {
  if (!at.is_on_member()) return displacement(at.node, direction);
  const int index = at.member;
  const AxisPoint point = place(index, at.fraction);
  return displacement(index, {point.x, point.y}, direction);
}

RigidParts::Row RigidParts::displacement(const ResolvedSpring& spring) const {
  const auto of = [&](const ResolvedLocation& at) {
    if (!spring.direction) return at.is_on_member() ? rotation(at.member) : node_rotation(at.node);
    return displacement(at, fixed_direction(*spring.direction, 1.0).fixed);
  };
  Row row = of(spring.at);
  if (spring.to) append(row, of(*spring.to), -1.0);
  return row;
}

RigidParts::Row RigidParts::rotation(int member) const {
  const int body = body_of_member_[static_cast<std::size_t>(member)];
  if (body >= 0) return {{bodies_[body].first + 2, 1.0 / bodies_[body].radius}};
  const Bar b = bar(member);
  const double square = b.chord[0] * b.chord[0] + b.chord[1] * b.chord[1];
  const Point across{-b.chord[1] / square, b.chord[0] / square};
  Row row = displacement(b.end, across);
  append(row, displacement(b.start, across), -1.0);
  return row;
}

RigidParts::Row RigidParts::node_rotation(int node) const {
  const int body = turns_with_[static_cast<std::size_t>(node)];
  if (body < 0) return {};
  return {{bodies_[body].first + 2, 1.0 / bodies_[body].radius}};
}

double RigidParts::radius(int member) const {
  const int body = body_of_member_[static_cast<std::size_t>(member)];
  if (body >= 0) return bodies_[body].radius;
  const Bar b = bar(member);
  return std::hypot(b.chord[0], b.chord[1]);
}

double RigidParts::node_radius(int node) const {
  const int body = turns_with_[static_cast<std::size_t>(node)];
  return body < 0 ? 0.0 : bodies_[body].radius;
}

std::vector<RigidParts::Row> RigidParts::joints() const {
  std::vector<Row> rows;
  const auto add = [&rows](Row row, const Row& other) {
    append(row, other, -1.0);
    rows.push_back(std::move(row));
  };
  for (std::size_t m = 0; m < ends_.size(); ++m) {
    const int body = body_of_member_[m];
    if (body < 0) {
      const Bar b = bar(static_cast<int>(m));
      const double chord = std::hypot(b.chord[0], b.chord[1]);
      const Point along{b.chord[0] / chord, b.chord[1] / chord};
      add(displacement(b.end, along), displacement(b.start, along));
      continue;
    }
    for (const int node : ends_[m]) {
      if (moves_with_[node] == body) continue;
      for (const Point& direction : {Point{1.0, 0.0}, Point{0.0, 1.0}})
        add(of_body(body, place(node), direction), displacement(node, direction));
    }
  }
  return rows;
}

std::vector<RigidParts::Row> RigidParts::turns() const {
  std::vector<Row> rows;
  for (const Body& body : bodies_) rows.push_back({{body.first + 2, 1.0 / body.radius}});
  for (std::size_t m = 0; m < ends_.size(); ++m) {
    if (body_of_member_[m] >= 0) continue;
    const auto [start, end] = ends_[m];
    for (const Point& direction : {Point{1.0, 0.0}, Point{0.0, 1.0}}) {
      rows.push_back(displacement(end, direction));
      append(rows.back(), displacement(start, direction), -1.0);
    }
  }
  return rows;
}

Eigen::SparseMatrix<double> matrix_of(const std::vector<RigidParts::Row>& rows, int columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const auto& [unknown, weight] : rows[i]) entries.emplace_back(static_cast<int>(i), unknown, weight);
  Eigen::SparseMatrix<double> out(static_cast<Eigen::Index>(rows.size()), columns);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace snapthrough
