#include "solver/discrete/follower_parts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>

#include "solver/mesh/dof_map.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Sets of unknowns that are connected with each other.
class ConnectedUnknowns {
 public:
  explicit ConnectedUnknowns(const Structure& structure);

  /// Number of the set of an unknown.
  [[nodiscard]] int set_of(int unknown) {
    int& up = above_[static_cast<std::size_t>(unknown)];
    while (up != above_[static_cast<std::size_t>(up)]) up = above_[static_cast<std::size_t>(up)];
    return up;
  }
  [[nodiscard]] bool is_held(int unknown) const {
    return unknown < DofMap::count(structure_.nodes) &&
           std::ranges::all_of(structure_.supports[static_cast<std::size_t>(DofMap::node(unknown))].fixed,
                               [](bool fixed) { return fixed; });
  }

 private:
  void connect(int a, int b) {
    if (!is_held(a) && !is_held(b)) above_[static_cast<std::size_t>(set_of(a))] = set_of(b);
  }

  const Structure& structure_;
  std::vector<int> above_;
};

ConnectedUnknowns::ConnectedUnknowns(const Structure& structure)
    : structure_(structure), above_(static_cast<std::size_t>(structure.size)) {
  std::iota(above_.begin(), above_.end(), 0);
  const int p = structure.mesh.order;
  for (const ElementDofs& dofs : structure.dofs) {
    for (int i = 1; i < DofMap::count(p); ++i) connect(dofs.v, dofs.v + i);
    for (int c = 0; c < 3; ++c) {
      connect(dofs.v, dofs.a[static_cast<std::size_t>(c)]);
      connect(dofs.v, dofs.b[static_cast<std::size_t>(c)]);
    }
  }
  for (const NodeSpring& spring : structure.node_springs)
    for (int c = 0; c < 3 && spring.to >= 0 && spring.to < structure.first_ground; ++c)
      connect(DofMap::first(spring.node) + c, DofMap::first(spring.to) + c);
  for (const JointSpring& joint : structure.joints) connect(joint.node_rotation, joint.end_rotation);
}

/// Adds a combination of unit forces at a place of a load, with one factor for each component.
template <class Term>
void add_forces(const std::vector<Term>& terms, const VectorXd& factors, Eigen::Ref<VectorXd> out) {
  for (const Term& term : terms) {
    out[term.x] += term.weight * factors[0];
    out[term.y] += term.weight * factors[1];
    if constexpr (requires { term.turn; }) out[term.turn] += term.weight * factors[2];
  }
}

}  // namespace

std::vector<MatrixXd> follower_parts(const Structure& structure, Index columns) {
  ConnectedUnknowns connected(structure);
  std::map<int, std::size_t> number;  // number of a part by its set of unknowns
  std::vector<MatrixXd> out;
  unsigned seed = 0;
  const auto add = [&](const auto& load) {
    const auto moves = [&](const auto& term) { return !connected.is_held(term.x); };
    const auto free = std::ranges::find_if(load.terms, moves);
    if (free == load.terms.end()) return;
    const auto [at, is_new] = number.try_emplace(connected.set_of(free->x), out.size());
    if (is_new) out.emplace_back(MatrixXd::Zero(structure.size, columns));
    for (Index j = 0; j < columns; ++j)
      add_forces(load.terms, pseudo_random(3, ++seed), out[at->second].col(j));
  };
  for (const FollowerEnd& end : structure.follower_ends) add(end);
  for (const FollowerForce& force : structure.follower_forces) add(force);
  return out;
}

}  // namespace snapthrough
