#include "solver/discrete/mass_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/lanes.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {
namespace {

using Eigen::Index;

const Section& section_on(const ResolvedModel& model, int member) {
  return model.sections[model.members[member].section];
}

/// Place on a member for a node: the end of a member that turns with the node, if there is one.
std::pair<int, double> place_at_node(const ResolvedModel& model, int node) {
  std::pair<int, double> out{-1, 0.0};
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const ResolvedMember& member = model.members[m];
    for (const bool at_start : {true, false}) {
      if ((at_start ? member.start : member.end) != node) continue;
      const bool turns = !(at_start ? member.release_start_rotation : member.release_end_rotation);
      if (turns || out.first < 0) out = {static_cast<int>(m), at_start ? 0.0 : 1.0};
      if (turns) return out;
    }
  }
  return out;
}

MassPlace place_at(const CollocationRule& rule, double xi, double mass, double rotary) {
  MassPlace out;
  rule.integrals_at(xi, std::span(out.integrals).first(static_cast<std::size_t>(rule.order())));
  out.mass = mass;
  out.rotary = rotary;
  return out;
}

/// Collects the places of each element, in the model's units of mass and the scaled unit of length.
std::vector<std::vector<MassPlace>> collect_places(const Structure& structure) {
  const ResolvedModel& model = *structure.model;
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const Quadrature gauss = gauss_legendre(rule.order() + 1);
  const double unit = structure.scales.length;
  std::vector<std::vector<MassPlace>> out(structure.dofs.size());
  for (std::size_t e = 0; e < out.size(); ++e) {
    const MeshElement& cell = structure.mesh.elements[e];
    const Section& section = section_on(model, cell.member);
    if (!section.mass && !section.rotary_inertia) continue;
    const double length = length_of_element(structure, static_cast<int>(e)) * unit;
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
      const double at = cell.from + gauss.points[q] * (cell.to - cell.from);
      const double weight = length * gauss.weights[q];
      const double mass = weight * section.mass.value_or(0.0).at(at);
      const double rotary = weight * section.rotary_inertia.value_or(0.0).at(at) / (unit * unit);
      if (mass != 0.0 || rotary != 0.0) out[e].push_back(place_at(rule, gauss.points[q], mass, rotary));
    }
  }
  for (const ResolvedPointMass& point : model.masses) {
    const auto [member, fraction] = point.at.is_on_member() ? std::pair{point.at.member, point.at.fraction}
                                                            : place_at_node(model, point.at.node);
    if (member < 0) continue;
    const MeshPlace place = place_of(structure.mesh, member, fraction);
    out[static_cast<std::size_t>(place.element)].push_back(
        place_at(rule, place.xi, point.mass, point.inertia / (unit * unit)));
  }
  return out;
}

MassBlocks blocks_of(std::span<const MassPlace> places, double h, int order) {
  MassBlocks out;
  Eigen::VectorXd moved(order + 1);  // displacement of the place by the values of one component
  moved[0] = 1.0;
  const auto add = [&](double mass, Eigen::MatrixXd& block) {
    if (mass == 0.0) return;
    if (block.size() == 0) block.setZero(order + 1, order + 1);
    block += mass * moved * moved.transpose();
  };
  for (const MassPlace& place : places) {
    for (int r = 0; r < order; ++r) moved[r + 1] = h * place.integrals[static_cast<std::size_t>(r)];
    add(place.mass, out.moving);
    add(place.rotary, out.turning);
  }
  return out;
}

/// Adds the forces of the mass of one component of an element, for at most kLanes motions.
/// @param a unknown of the value at the node
/// @param v first unknown of the displacement gradients
void add_forces(const Eigen::MatrixXd& block, Index a, Index v,
                const Eigen::Ref<const Eigen::MatrixXd>& motions, Eigen::Ref<Eigen::MatrixXd> out) {
  using Lane = Eigen::Array<double, kLanes, 1>;
  std::array<Lane, kMaxOrder + 1> values;
  const Index p = block.rows() - 1;
  const Index count = motions.cols();
  for (Index r = 0; r <= p; ++r) {
    Lane& lane = values[static_cast<std::size_t>(r)];
    const Index row = r == 0 ? a : v + r - 1;
    lane.setZero();
    for (Index j = 0; j < count; ++j) lane[j] = motions(row, j);
  }
  for (Index r = 0; r <= p; ++r) {
    Lane force = Lane::Zero();
    for (Index q = 0; q <= p; ++q) force += block(q, r) * values[static_cast<std::size_t>(q)];
    const Index row = r == 0 ? a : v + r - 1;
    for (Index j = 0; j < count; ++j) out(row, j) += force[j];
  }
}

/// Motions of heavy places that supports leave free.
Index free_motions_of_places(const Structure& structure) {
  const ResolvedModel& model = *structure.model;
  std::set<std::tuple<int, int, double, int>> motions;  // a place and a component
  for (const ResolvedPointMass& point : model.masses) {
    for (int c = 0; c < 3; ++c) {
      const bool moves = (c < 2 ? point.mass : point.inertia) > 0.0;
      const bool is_fixed =
          !point.at.is_on_member() && structure.supports[static_cast<std::size_t>(point.at.node)].fixed[c];
      if (moves && !is_fixed) motions.emplace(point.at.node, point.at.member, point.at.fraction, c);
    }
  }
  return static_cast<Index>(motions.size());
}

}  // namespace

bool is_heavy(const Section& section) { return section.mass && section.mass->largest() > 0.0; }

MassMatrix make_mass_matrix(const Structure& structure) {
  const ResolvedModel& model = *structure.model;
  const std::vector<std::vector<MassPlace>> places = collect_places(structure);
  MassMatrix out;
  double total = 0.0;
  double length = 0.0;
  out.elements.first.push_back(0);
  for (std::size_t e = 0; e < places.size(); ++e) {
    length += length_of_element(structure, static_cast<int>(e));
    for (const MassPlace& place : places[e]) total += place.mass + place.rotary;
    out.elements.places.insert(out.elements.places.end(), places[e].begin(), places[e].end());
    out.elements.first.push_back(static_cast<int>(out.elements.places.size()));
  }
  // the unit of mass makes the mean mass per scaled length one
  const double unit = total / length;
  for (MassPlace& place : out.elements.places) {
    place.mass /= unit;
    place.rotary /= unit;
  }
  for (std::size_t e = 0; e < places.size(); ++e) {
    const auto first = static_cast<std::size_t>(out.elements.first[e]);
    const auto count = static_cast<std::size_t>(out.elements.first[e + 1]) - first;
    out.blocks.push_back(blocks_of(std::span(out.elements.places).subspan(first, count),
                                   length_of_element(structure, static_cast<int>(e)), structure.mesh.order));
  }
  out.square = structure.scales.force / (structure.scales.length * unit);
  out.scale = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const double l = structure.axes[m]->length() / structure.scales.length;
    out.scale = std::min(out.scale, structure.euler_loads[m] * std::numbers::pi * std::numbers::pi / (l * l));
  }
  out.rank = std::any_of(model.sections.begin(), model.sections.end(), is_heavy)
                 ? structure.size
                 : free_motions_of_places(structure);
  return out;
}

Eigen::MatrixXd mass_products(const Structure& structure, const MassMatrix& masses,
                              const Eigen::Ref<const Eigen::MatrixXd>& motions) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(motions.rows(), motions.cols());
  for (Index from = 0; from < motions.cols(); from += kLanes) {
    const Index count = std::min<Index>(kLanes, motions.cols() - from);
    for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
      const ElementDofs& dofs = structure.dofs[e];
      for (int c = 0; c < 3; ++c) {
        const Eigen::MatrixXd& block = c < 2 ? masses.blocks[e].moving : masses.blocks[e].turning;
        if (block.size() > 0)
          add_forces(block, dofs.a[c], dofs.v + c * structure.mesh.order, motions.middleCols(from, count),
                     out.middleCols(from, count));
      }
    }
  }
  return out;
}

}  // namespace snapthrough
