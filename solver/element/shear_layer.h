#pragma once
/// @file
/// Contact of a member with a one-sided foundation that has a shear layer.
///
/// The ground's surface g is a string with the tension G on springs K, and the member pushes it: g minimises
///
///   1/2 int (K g^2 + G g'^2) ds    with    g >= w,    w the member's penetration.
///
/// Outside contact K g = G g'', so that g is known from w at the ends of contact: with k = sqrt(K / G), the
/// ground beyond an end resists w there with G k (endless ground) or G k tanh(k l) (ground that ends free at
/// a distance l), and between two ends at a distance l it has the energy
///
///   1/2 G k [ tanh(k l / 2) (w_1^2 + w_2^2) + (w_1 - w_2)^2 / sinh(k l) ].
///
/// An end inside the member lies where the surface leaves it tangentially; the energy is then stationary with
/// respect to the end's place, and the tangent stiffness with fixed ends is exact.
/// Source: docs/decisions/0033.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/element/foundation_contact.h"
#include "solver/numeric/max_order.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// Displacements of an element under a foundation with a shear layer.
struct LayerCell {
  const FoundationContact* contact = nullptr;
  std::array<double, 2> start{};             ///< displacement (x, y) at the element's start
  std::array<double, kMaxOrder> dx{}, dy{};  ///< h u'_x and h u'_y at the Gauss points
  int order = 0;
  double above = 0.0;  ///< added to the penetration

  /// Penetration at xi in [0, 1] of the element.
  [[nodiscard]] double depth(double xi) const {
    return contact->penetration(xi, start, gradient(dx), gradient(dy)) + above;
  }
  /// Derivative of depth() by arc length.
  [[nodiscard]] double slope(double xi) const {
    return contact->penetration_slope(xi, start, gradient(dx), gradient(dy)) / contact->length();
  }
  /// Second derivative of depth() by arc length.
  [[nodiscard]] double bend(double xi) const;
  /// Contact pressure K w - G w'' where the member touches.
  [[nodiscard]] double pressure(double xi) const {
    return contact->modulus() * depth(xi) - contact->shear() * bend(xi);
  }
  /// Arc length from the member's start.
  [[nodiscard]] double arc(double xi) const { return contact->start() + xi * contact->length(); }
  [[nodiscard]] std::span<const double> gradient(const std::array<double, kMaxOrder>& d) const {
    return std::span<const double>(d).first(static_cast<std::size_t>(order));
  }
};

/// Stiffnesses and ends of a shear layer; lengths and forces are scaled.
struct ShearLayer {
  double shear = 0.0;    ///< G
  double modulus = 0.0;  ///< K
  bool endless = false;  ///< whether the ground continues beyond the range; else it ends free there
  double from = 0.0;     ///< arc length of the range's start
  double to = 0.0;       ///< arc length of the range's end

  /// Decay k of the surface beside contact.
  [[nodiscard]] double decay() const { return std::sqrt(modulus / shear); }
};
/// @pre cells are those of one foundation, ascending, at least one
[[nodiscard]] ShearLayer layer_of(std::span<const LayerCell> cells);

/// Parts of the cells that the member touches, one list for each cell. A member that touches at one point
/// has a part without length.
using LayerParts = std::vector<std::vector<ElementPart>>;
[[nodiscard]] LayerParts touching_parts(std::span<const LayerCell> cells);
/// Parts that touch if only some cells of a layer can.
[[nodiscard]] LayerParts touching_parts(std::span<const LayerCell> some, const ShearLayer& layer);
/// Whether the penetration exceeds a depth at some sample.
[[nodiscard]] bool is_pressed(std::span<const LayerCell> cells, double depth);

/// End of a contact zone, with the ground beyond it.
struct LayerEdge {
  std::size_t cell = 0;
  double xi = 0.0;
  bool begins = false;      ///< the zone begins here, and the ground beyond lies before it
  double stiffness = 0.0;   ///< resistance to w at the edge alone
  int other = -1;           ///< edge at the other side of the ground beyond; -1: none
  double compliance = 0.0;  ///< inverse of the resistance to w at this edge less w at the other
};
/// @brief Ends of the zones that given parts form; adjacent parts are joined.
/// @param displacements of the cells are not used
[[nodiscard]] std::vector<LayerEdge> edges_of(std::span<const LayerCell> cells, const LayerParts& parts);

/// @brief Force of the ground beyond an end of contact on the member, against the direction into the medium.
[[nodiscard]] double edge_force(std::span<const LayerCell> cells, std::span<const LayerEdge> edges,
                                std::size_t index);
/// Whether an end of contact stays at its place when the displacements change: at an end of a cell.
[[nodiscard]] bool is_held(std::span<const LayerCell> cells, const LayerEdge& edge);
/// @brief Rate of the arc length of an end of contact, G (v' - c') / (K w - G w''), where c is the surface
/// beyond the end that follows the changes v of the penetration.
/// @param rates changes of the cells' penetrations
[[nodiscard]] double edge_rate(std::span<const LayerCell> cells, std::span<const LayerCell> rates,
                               std::span<const LayerEdge> edges, std::size_t index);

}  // namespace snapthrough
