#pragma once
/// @file
/// Rigid bodies of a structure of rigid members, and the joints between them.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/mesh/mesh.h"
#include "solver/model/scales.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Small motions of a structure with rigid members.
///
/// Members joined without release form one body, whose unknowns are two displacements and the rotation about
/// its middle (times its radius). A member released at both ends is a bar without unknowns of its own; its
/// end displacements define its motion. Nodes that only bars reach have two unknowns. Lengths are divided by
/// that of the longest member, positions are relative to the first node.
class RigidParts {
 public:
  /// Linear functional of the unknowns; an unknown may occur several times.
  using Row = std::vector<std::pair<int, double>>;
  using Point = std::array<double, 2>;

  /// @param model kept by reference
  explicit RigidParts(const ResolvedModel& model);

  [[nodiscard]] int unknowns() const { return unknowns_; }
  [[nodiscard]] const ResolvedModel& model() const { return model_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const Axes& axes() const { return axes_; }
  [[nodiscard]] Point place(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  /// Law of a foundation in the coordinates of these parts; its forces are not scaled.
  [[nodiscard]] FoundationLaw law(const ResolvedFoundation& foundation) const {
    Scales scales;
    scales.length = length_;
    return law_of(foundation, scales, {model_.nodes.front().x, model_.nodes.front().y});
  }
  /// Axis point at a fraction of a member.
  [[nodiscard]] AxisPoint place(int member, double fraction) const;

  /// Displacement of a node in a direction.
  [[nodiscard]] Row displacement(int node, Point direction) const;
  /// Displacement, in a direction, of a point that moves with a member.
  [[nodiscard]] Row displacement(int member, Point at, Point direction) const;
  /// Displacement of a location in a direction.
  [[nodiscard]] Row displacement(const ResolvedLocation& at, Point direction) const;
  /// Displacement of a spring along its direction, or its rotation; relative to the node `to` where it is
  /// given.
  [[nodiscard]] Row displacement(const ResolvedSpring& spring) const;
  /// Rotation of a member.
  [[nodiscard]] Row rotation(int member) const;
  /// Rotation of a node; empty when all members are released there.
  [[nodiscard]] Row node_rotation(int node) const;
  /// Lever of a rotation: half the extent of a body, or the chord of a bar.
  [[nodiscard]] double radius(int member) const;
  [[nodiscard]] double node_radius(int node) const;

  /// Rows that vanish in a strain-free motion: bars keep their length, bodies meet at their common nodes.
  [[nodiscard]] std::vector<Row> joints() const;
  /// Rotations of all bodies times the unit of length, and relative displacements of the ends of all bars.
  [[nodiscard]] std::vector<Row> turns() const;

 private:
  struct Body {
    int first = 0;  ///< index of the body's first unknown
    Point middle{};
    double radius = 0.0;
  };
  struct Bar {
    int start = 0;
    int end = 0;
    Point chord{};
  };
  void find_bodies();
  void place_bodies();
  void number_nodes();
  [[nodiscard]] std::array<int, 2> ends(std::size_t member) const;
  [[nodiscard]] Row of_body(int body, Point at, Point direction) const;
  [[nodiscard]] Bar bar(int member) const;

  const ResolvedModel& model_;
  Axes axes_;
  double length_ = 0.0;
  int unknowns_ = 0;
  std::vector<Point> nodes_;
  std::vector<std::array<int, 2>> ends_;  ///< nodes of each member
  std::vector<Body> bodies_;
  std::vector<int> body_of_member_;  ///< body of each member; -1: a bar
  std::vector<int> turns_with_;     ///< body whose rotation a node shares; -1: all members are released there
  std::vector<int> moves_with_;     ///< body whose displacement a node shares; -1: only bars reach the node
  std::vector<int> first_of_node_;  ///< index of the node's own unknowns, if it moves with no body
};

/// @brief Sparse matrix with the given rows.
[[nodiscard]] Eigen::SparseMatrix<double> matrix_of(const std::vector<RigidParts::Row>& rows, int columns);

}  // namespace snapthrough
