#pragma once
/// @file
/// Springs between a node and the ground, or between two nodes.

#include <Eigen/Core>
#include <array>
#include <memory>

#include "solver/element/element_set.h"
#include "solver/mesh/dof_map.h"
#include "solver/support/catenary.h"
#include "solver/support/law.h"

namespace snapthrough {

/// Displacement w of a spring with its derivatives by r, see NodeSpring.
struct SpringMotion {
  double w = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();  ///< second derivative
};

/// @brief Spring at a node, to the ground or to another node; lengths are scaled.
///
/// With r the displacement (x, y, rotation) of `node`, relative to `to` where it is given, the displacement
/// of the spring is
///
///   w = row . r                                     along a fixed direction
///   w = sense (L - l),   l = |L sense row - r|      of a rod of the length L, whose end `to` lies L sense
///   row
///                                                   from `node`: its shortening or lengthening
///
/// A rod's w is row . r too where displacements count as small. With a pretension, w is less by sense times
/// the unknown `without_force`, which is prescribed.
///
/// A cable has no w: it pulls by its chord, and its lengthening without force is minus that unknown. Its
/// force is counted from that as it is drawn, which belongs to the constant actions: without them every
/// structure is in equilibrium as it is drawn.
///
/// The force p of a stop is an unknown, because stiffness times penetration would be the rounding of the
/// displacements. A stop of the compliance c and the gap g acts where  w - g + p / k - c p > 0;  there
/// w - g = c p, elsewhere p = 0 (the complementarity function of Alart and Curnier, Comput. Methods Appl.
/// Mech. Eng. 92, 1991). The stiffness k of `law` makes a force a distance and is no stiffness of the stop.
/// Readings of a stop's displacement, and w of motion(), include p / k - c p.
struct NodeSpring {
  int node = 0;
  int to = -1;  ///< node at the other end; -1: the ground
  std::array<double, 3> row{};
  double sense = 1.0;   ///< 1: w is a rod's shortening; -1: its lengthening
  double length = 0.0;  ///< length of a rod; 0: the direction is fixed
  Law law;
  Touch touch = Touch::none;
  int spring = -1;                          ///< index among the springs
  int force_unknown = -1;                   ///< unknown force of a stop; -1: the law gives the force
  double give = 0.0;                        ///< compliance of a stop
  std::shared_ptr<const Catenary> cable{};  ///< null: the spring is none
  Eigen::Vector2d drawn_pull = Eigen::Vector2d::Zero();  ///< pull of a cable on `node`, as it is drawn
  int without_force = -1;                                ///< unknown of a pretension; -1: none

  [[nodiscard]] bool is_rod() const { return length > 0.0; }
  [[nodiscard]] bool is_cable() const { return cable != nullptr; }
  [[nodiscard]] bool is_stop() const { return force_unknown >= 0; }
  /// Displacement r in a vector of unknowns.
  [[nodiscard]] Eigen::Vector3d relative(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    Eigen::Vector3d r = DofMap::at(y, node);
    if (to >= 0) r -= DofMap::at(y, to);
    return r;
  }
  /// Adds a force on `node`, and its opposite on `to`, to nodal forces.
  void add(const Eigen::Vector3d& force, Eigen::Ref<Eigen::VectorXd> forces) const {
    DofMap::at(forces, node) += force;
    if (to >= 0) DofMap::at(forces, to) -= force;
  }
  [[nodiscard]] Eigen::Vector3d direction() const { return {row[0], row[1], row[2]}; }
  /// What a pretension adds to w, at the unknowns y.
  [[nodiscard]] double pretensioned(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return without_force >= 0 ? -sense * y[without_force] : 0.0;
  }
  /// Chord and lengthening of a cable at the unknowns y. @pre cable is not null
  [[nodiscard]] Catenary::Ends ends(const Eigen::Ref<const Eigen::VectorXd>& y) const;
  /// Their changes along the unknowns.
  [[nodiscard]] Catenary::Ends change_of_ends(const Eigen::Ref<const Eigen::VectorXd>& along) const;
  /// Displacement w at the unknowns y, for small displacements, without the force of a stop.
  [[nodiscard]] double moved(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return direction().dot(relative(y)) + pretensioned(y);
  }
  /// Displacement w at the unknowns y, for small displacements.
  [[nodiscard]] double linear(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return is_stop() ? moved(y) + (1.0 / law.stiffness - give) * y[force_unknown] : moved(y);
  }
  /// Displacement w at the unknowns y, with its derivatives.
  [[nodiscard]] SpringMotion motion(const Eigen::Ref<const Eigen::VectorXd>& y,
                                    bool small_displacements) const;
  /// Derivative of SpringMotion::curvature along the unknowns `along`. @pre is_rod()
  [[nodiscard]] Eigen::Matrix3d curvature_change(const Eigen::Ref<const Eigen::VectorXd>& y,
                                                 const Eigen::Ref<const Eigen::VectorXd>& along) const;
  /// Whether the spring reacts at a displacement w.
  [[nodiscard]] bool acts(double w) const;

 private:
  /// Unit vector along a rod from `node` to `to`, the unit vector across it, and its length.
  struct Chord {
    Eigen::Vector3d along;
    Eigen::Vector3d across;
    double length;
  };
  [[nodiscard]] Chord chord(const Eigen::Vector3d& r) const;
};

/// Spring at a node, or between nodes, by its law. @param node, to as in NodeSpring
[[nodiscard]] NodeSpring node_spring(const SpringLaw& law, int node, int to);

}  // namespace snapthrough
