#pragma once
/// @file
/// A structure of rigid members: what moves as one body, and what joins the bodies.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/mesh/mesh.h"
#include "solver/model/id_index.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief Small motions of a structure whose members do not deform.
///
/// Members that are joined without release are one body, with two displacements and a rotation about its
/// middle (times its radius) as unknowns. A member released at both ends, a bar, has none of its own: its
/// ends' displacements are its motion. Nodes that only bars reach have two unknowns. Lengths are over that of
/// the longest member, relative to the first node. A frame of rigid joints is one body, however large it is.
class RigidParts {
 public:
  /// Linear functional of the unknowns; an unknown may be there several times.
  using Row = std::vector<std::pair<int, double>>;
  using Point = std::array<double, 2>;

  /// @param model kept by reference
  explicit RigidParts(const Model& model);

  [[nodiscard]] int unknowns() const { return unknowns_; }
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] int node(const std::string& id) const { return node_index_.of(id); }
  [[nodiscard]] int member(const std::string& id) const { return member_index_.of(id); }
  [[nodiscard]] const Axes& axes() const { return axes_; }
  [[nodiscard]] Point place(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  /// At a fraction of a member.
  [[nodiscard]] AxisPoint place(int member, double fraction) const;

  /// Displacement of a node in a direction.
  [[nodiscard]] Row displacement(int node, Point direction) const;
  /// Displacement of a point that moves with a member in a direction.
  [[nodiscard]] Row displacement(int member, Point at, Point direction) const;
  /// Rotation of a member.
  [[nodiscard]] Row rotation(int member) const;
  /// Rotation of a node; empty where all members are released.
  [[nodiscard]] Row node_rotation(int node) const;
  /// Length by which a rotation moves what it turns: half a body's extent, or a bar's chord.
  [[nodiscard]] double radius(int member) const;
  [[nodiscard]] double node_radius(int node) const;

  /// Rows that are zero in a motion without strain: bars keep their length, bodies that meet in a node move
  /// it alike.
  [[nodiscard]] std::vector<Row> joints() const;
  /// Rotations of all bodies times the unit of length, and differences of displacement of all bars' ends.
  [[nodiscard]] std::vector<Row> turns() const;

 private:
  struct Body {
    int first = 0;  ///< of its unknowns
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

  const Model& model_;
  IdIndex node_index_;
  IdIndex member_index_;
  Axes axes_;
  double length_ = 0.0;
  int unknowns_ = 0;
  std::vector<Point> nodes_;
  std::vector<std::array<int, 2>> ends_;  ///< nodes of each member
  std::vector<Body> bodies_;
  std::vector<int> body_of_member_;  ///< -1: a bar
  std::vector<int> turns_with_;      ///< body that a node turns with, -1 when all members are released there
  std::vector<int> moves_with_;      ///< body that a node moves with, -1 when only bars reach it
  std::vector<int> first_of_node_;   ///< of its own unknowns, where it moves with no body
};

/// @brief A matrix of rows.
[[nodiscard]] Eigen::SparseMatrix<double> matrix_of(const std::vector<RigidParts::Row>& rows, int columns);

}  // namespace snapthrough
