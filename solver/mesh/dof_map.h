#pragma once
/// @file
/// Where the unknowns of nodes stand in a vector of unknowns.

#include <Eigen/Core>
#include <array>
#include <utility>

namespace snapthrough {

/// @brief Maps nodes and components to unknowns: those of node 0 are first, then those of node 1, and so on.
///
/// Components 0 and 1 are the displacements along x and y, component 2 is the rotation. A Gauss point has as
/// many unknown strains, and as many section forces.
struct DofMap {
  static constexpr int components = 3;

  /// Number of unknowns of some nodes, or Gauss points.
  template <class Index>
  [[nodiscard]] static constexpr Index count(Index nodes) {
    return components * nodes;
  }
  /// First unknown of a node.
  template <class Index>
  [[nodiscard]] static constexpr Index first(Index node) {
    return components * node;
  }
  [[nodiscard]] static constexpr int rotation(int node) { return first(node) + 2; }
  [[nodiscard]] static constexpr std::array<int, components> of(int node) {
    return {first(node), first(node) + 1, rotation(node)};
  }
  /// Node of an unknown. @pre the unknown belongs to a node
  template <class Index>
  [[nodiscard]] static constexpr Index node(Index unknown) {
    return unknown / components;
  }
  /// Component of an unknown. @pre the unknown belongs to a node
  template <class Index>
  [[nodiscard]] static constexpr Index component(Index unknown) {
    return unknown % components;
  }
  /// Displacement (x, y) and rotation of a node, in a vector that has a value for each unknown.
  template <class Vector>
  [[nodiscard]] static auto at(Vector&& unknowns, Eigen::Index node) {
    return std::forward<Vector>(unknowns).template segment<components>(first(node));
  }
  /// Displacement (x, y) of a node, in a vector that has a value for each unknown.
  template <class Vector>
  [[nodiscard]] static auto displacement(Vector&& unknowns, Eigen::Index node) {
    return std::forward<Vector>(unknowns).template segment<2>(first(node));
  }
};

}  // namespace snapthrough
