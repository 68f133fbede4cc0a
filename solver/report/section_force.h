#pragma once
/// @file
/// Section forces of one element from equilibrium.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/layer_state.h"
#include "solver/discrete/structure.h"
#include "solver/resolve/action.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Force and moment through any section of an element.
///
/// The force through the element's end is an unknown of the solution. The actions between a section and that
/// end (dead loads, follower pressure, foundations, springs) are integrated and added:
///
///   n(xi) = m_f + int_xi^1 f ds,     M(xi) = m_m + (x_b - x) x m_f + int_xi^1 (x(s) - x) x f ds
///
/// N, Q and M are thus in equilibrium with the loads at every section, without differentiating strains.
class SectionForces {
 public:
  /// @param lambda scaled load factor of the state y
  /// @param layers see layer_states(); not used after construction
  SectionForces(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                const std::vector<LayerState>& layers, int element);

  /// (force x, force y, moment) at xi in [0, 1] of the part beyond xi on the part before it, scaled.
  [[nodiscard]] std::array<double, 3> at(double xi) const;
  /// Places in (0, 1), ascending, where actions begin, end or are concentrated: the forces jump there or
  /// turn.
  [[nodiscard]] std::vector<double> breaks() const;

 private:
  using Vec2 = std::array<double, 2>;
  struct DeadLoad {
    LinePiece piece;
    double factor;  ///< from forces of the piece to scaled forces of the state
    LoadMeasure per;
    LoadAxes axes;
    Vec2 range;  ///< part of the element, in [0, 1]
  };
  struct FoundationHere {
    FoundationLaw law;
    ElementReader reader;  ///< displacements relative to the ground
    bool lumped;           ///< true: its reaction consists of point forces
    Vec2 range;
    std::vector<FoundationContact::Interval> contact;

    /// Whether a place is inside the contact.
    [[nodiscard]] bool touches(double xi) const {
      return std::any_of(contact.begin(), contact.end(),
                         [xi](const auto& part) { return part.from <= xi && xi <= part.to; });
    }
    /// Whether the part beyond a section begins in contact; the section at an end of contact is beyond it. A
    /// member that touches at one point has no contact beside it.
    [[nodiscard]] bool is_cut(double xi) const {
      return std::any_of(contact.begin(), contact.end(), [xi](const auto& part) {
        return part.to - part.from > kOnePlace && part.from <= xi &&
               (xi < part.to || (xi == 1.0 && part.to == 1.0));
      });
    }
  };
  struct PointForce {
    double xi;
    std::array<double, 3> action;
  };

  void add_loads(const Eigen::VectorXd& y, double proportional, double constant);
  /// Adds an action on the member, times a factor.
  void add(const PointAction& load, const Eigen::VectorXd& y, double factor);
  void add(const LineAction& load, const Eigen::VectorXd& y, double factor);
  void add(const PressureAction& load, const Eigen::VectorXd& y, double factor);
  void add(const StrainAction&, const Eigen::VectorXd&, double) {}
  /// Action of a point load on the member of the element, at the place xi.
  [[nodiscard]] PointForce point_force(const PointAction& load, double xi, const Eigen::VectorXd& y,
                                       double factor) const;
  void release_end_of_pressure(const Eigen::VectorXd& y);
  void add_foundations(const Eigen::VectorXd& y, const std::vector<LayerState>& layers);
  void add_springs(const Eigen::VectorXd& y);
  void add_layer_forces(const LayerState& layer);
  void add_lumped(const FoundationHere& foundation);
  /// Perfect axis at xi; the last value is cached.
  [[nodiscard]] const AxisPoint& axis_at(double xi) const;
  [[nodiscard]] Vec2 position(double xi) const;
  /// Derivative of the position by the scaled arc length of the perfect axis.
  [[nodiscard]] Vec2 slope(double xi) const;
  /// Unit direction into the medium of a foundation with a shear layer, and its derivative with respect to s.
  [[nodiscard]] Vec2 normal_into(const FoundationLaw& foundation, double xi) const {
    return foundation.direction.at(axis_at(xi).angle);
  }
  [[nodiscard]] Vec2 normal_rate(const FoundationLaw& foundation, double xi) const {
    return foundation.direction.rate(axis_at(xi).angle,
                                     structure_.scales.scaled_curvature(axis_at(xi).curvature));
  }
  /// Reaction of a foundation per length, on the member: force (x, y) and moment.
  [[nodiscard]] std::array<double, 3> reaction(const FoundationHere& foundation, double xi) const;
  /// Force (x, y) and moment per length at a section, without shear layers.
  [[nodiscard]] std::array<double, 3> density(double xi) const;
  [[nodiscard]] double shear_layer(const FoundationLaw& foundation, double xi) const;
  void add_shear_layers(double xi, double from, double to, std::array<double, 3>& sum) const;
  [[nodiscard]] std::vector<double> breaks_beyond(double xi) const;

  const Structure& structure_;
  const ResolvedModel& model_;
  int element_;
  const MeshElement& cell_;
  ElementReader reader_;
  Quadrature gauss_;
  mutable double last_xi_ = -1.0;
  mutable AxisPoint last_;
  std::array<double, 3> end_{};
  std::vector<DeadLoad> dead_;
  std::vector<FoundationHere> foundations_;
  std::vector<PointForce> points_;
  LinePressure pressure_;  ///< pressure along the deformed right normal
};

}  // namespace snapthrough
