#pragma once
/// @file
/// One-sided foundation on one element.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/axis_curve.h"
#include "solver/numeric/chebyshev_series.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/lanes.h"
#include "solver/support/law.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// @brief Winkler foundation on part of an element that is one-sided or has a law with a curve: reaction
/// p(g) per undeformed length along -d, with penetration g and unit direction d into the medium: g = u.d -
/// gap, or the depth below a surface and its normal (FoundationLaw::penetration()).
///
/// Integrals are split where g changes sign and where p is not smooth, so that they are C1 in the
/// displacements: a moving contact end is no event and gives no spurious limit point. Immutable, thread safe.
class FoundationContact {
 public:
  /// Position of the element on its member's initial axis.
  struct Place {
    std::shared_ptr<const AxisCurve> axis;  ///< empty when the direction is constant and there is no surface
    double s0 = 0.0;                        ///< arc length of the element's start, in the axis' units
    double ds = 0.0;                        ///< arc length of the element, in the axis' units
    double from = 0.0;                      ///< the element, in fractions of the member
    double to = 1.0;
    double length = 1.0;  ///< scaled length of the element
  };
  using Interval = ElementPart;

  /// @param range part of the element, in [0, 1]
  /// @pre place.axis is set when the direction turns or the law has a surface
  FoundationContact(int order, const FoundationLaw& law, Place place, std::array<double, 2> range,
                    int foundation);

  /// Quadrature on a contact interval, for elements of an order; cached, thread safe.
  [[nodiscard]] static const Quadrature& quadrature(int order);
  /// Copy with another law, for the foundation of an index; both share the samples.
  [[nodiscard]] FoundationContact with_law(const FoundationLaw& law, int foundation) const;
  /// Whether with_law() makes the contact of a law on a part of the same element.
  [[nodiscard]] bool is_on(const FoundationLaw& law, std::array<double, 2> range) const {
    return direction() == law.direction && foundation_law_.surface == law.surface && range_ == range;
  }
  /// @brief Law with the largest stiffness along the member, times the element's length, so that weights on
  /// [0, 1] integrate forces.
  [[nodiscard]] const Law& law() const { return law_; }
  /// Law at xi, times the element's length, with the gap there.
  [[nodiscard]] Law law_at(double xi) const;
  /// Whether the direction of the reaction turns as the axis moves.
  [[nodiscard]] bool follows_surface() const { return foundation_law_.follows_surface(); }
  [[nodiscard]] int foundation() const { return foundation_; }
  /// Whether the rotation stands for the displacement along x (FoundationLaw::rotational).
  [[nodiscard]] bool is_rotational() const { return foundation_law_.rotational; }
  /// Weights of (x, y, rotation) in the penetration. @param d direction into the medium
  [[nodiscard]] std::array<double, 3> row(const std::array<double, 2>& d) const {
    return foundation_law_.row(d);
  }
  /// Stiffness G of the shear layer, and modulus K.
  [[nodiscard]] double shear() const { return foundation_law_.shear; }
  /// Whether the ground with the shear layer continues beyond the foundation's range.
  [[nodiscard]] bool endless() const { return foundation_law_.endless; }
  [[nodiscard]] double modulus() const { return foundation_law_.law.stiffness; }
  [[nodiscard]] bool has_layer() const { return foundation_law_.has_layer(); }
  /// Scaled length of the element, and arc length from the member's start to the element's.
  [[nodiscard]] double length() const { return place_.length; }
  [[nodiscard]] double start() const { return place_.length * place_.from / (place_.to - place_.from); }
  /// Displacement of the ground under the element.
  [[nodiscard]] const GroundMotion& ground() const { return ground_; }
  [[nodiscard]] std::array<double, 2> range() const { return range_; }
  /// Direction into the medium on the initial axis.
  [[nodiscard]] std::array<double, 2> direction_at(double xi) const;
  /// Direction x, y of direction_at(), then the A_r of CollocationRule, at point i of quadrature() on the
  /// whole range.
  [[nodiscard]] std::span<const double> at_point(std::size_t i) const {
    const auto width = std::size_t{2} + static_cast<std::size_t>(rule_->order());
    return std::span<const double>(samples_->points).subspan(i * width, width);
  }

  /// @brief Penetration at xi.
  /// @param ua displacement (x, y) relative to ground() at the element's start; dx, dy: h times its
  /// derivatives u'_x, u'_y at the Gauss points
  [[nodiscard]] double penetration(double xi, std::array<double, 2> ua, std::span<const double> dx,
                                   std::span<const double> dy) const;
  /// @brief Penetration at xi with its derivatives with respect to the displacement u there.
  [[nodiscard]] SurfacePoint penetration_at(double xi, std::array<double, 2> u) const {
    return foundation_law_.penetration(place_at(xi), u);
  }
  /// Displacement at xi.
  [[nodiscard]] std::array<double, 2> displacement(double xi, std::array<double, 2> ua,
                                                   std::span<const double> dx,
                                                   std::span<const double> dy) const;
  /// @brief Slope d penetration / d xi.
  [[nodiscard]] double penetration_slope(double xi, std::array<double, 2> ua, std::span<const double> dx,
                                         std::span<const double> dy) const;
  /// Position in the element, with the penetration there.
  struct DepthAt {
    double xi = 0.0;
    double depth = 0.0;
  };
  /// Appends the penetrations at the samples of the range, both ends included.
  void append_samples(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                      std::vector<DepthAt>& out) const;
  /// @brief Intervals of the range in which K w - G w'' is above zero, with the penetration w + `above`;
  /// ascending, `out` is overwritten. @pre no surface, constant gap
  void pressed_intervals(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                         double above, std::vector<Interval>& out) const;
  /// Derivative of direction_at() by xi. @pre no surface
  [[nodiscard]] std::array<double, 2> direction_rate(double xi) const;
  /// @brief Whether the distance from touching is at most `distance` on the whole range.
  [[nodiscard]] bool is_near(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                             double distance) const;
  /// @brief Intervals of the range in contact (g > depth), ascending; `out` is overwritten. The whole range
  /// for a bilateral law.
  void contact_intervals(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                         std::vector<Interval>& out, double depth = 0.0) const;
  /// @brief Intervals of the range on which a motion is directed into the medium, as seen from the initial
  /// axis.
  void intervals_into(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                      std::vector<Interval>& out) const;

  /// Place at which the law has a knot.
  struct KnotPlace {
    double xi = 0.0;
    double stiffness_change = 0.0;  ///< change of the stiffness from below to above the knot, per element
    double slope = 0.0;  ///< d (penetration - that of the knot, or distance ahead of the seam) / d xi
    /// Change of SurfacePoint::bend from behind a seam to ahead of it, ahead being the direction that follows
    /// the normal by +90 degrees; zero for knots of laws.
    double bend_change = 0.0;
  };
  /// Whether integrals are taken on halves of the pieces between knots: a law with a curve, or a depth that
  /// is not linear in the displacement.
  [[nodiscard]] bool is_curved() const { return law_.curve != nullptr || follows_surface(); }
  /// @brief Places inside the range at which the penetration passes a knot of the law, or the axis a seam of
  /// the surface, ascending; `out` is overwritten. Contact ends are none.
  void knot_places(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                   std::vector<KnotPlace>& out) const;
  /// Calls take(piece) for each piece of an interval between neighbouring knots, ascending.
  template <class Take>
  static void for_each_piece(const std::vector<KnotPlace>& knots, Interval interval, const Take& take) {
    for (const KnotPlace& knot : knots) {
      if (!(knot.xi > interval.from && knot.xi < interval.to)) continue;
      take(Interval{interval.from, knot.xi});
      interval.from = knot.xi;
    }
    take(interval);
  }
  /// @brief Calls take(half) for both halves of each piece: the intervals of quadrature if is_curved(),
  /// on which the tangent is the derivative of the quadrature to about ten digits.
  template <class Take>
  static void for_each_half(const std::vector<KnotPlace>& knots, Interval interval, const Take& take) {
    for_each_piece(knots, interval, [&take](const Interval& piece) {
      const double middle = 0.5 * (piece.from + piece.to);
      take(Interval{piece.from, middle});
      take(Interval{middle, piece.to});
    });
  }
  /// @brief Intervals of quadrature of the acting parts; ascending.
  [[nodiscard]] std::vector<Interval> smooth_pieces(std::array<double, 2> ua, std::span<const double> dx,
                                                    std::span<const double> dy) const;

 private:
  // samples stand four to an entry of Lanes; lanes beyond the last sample are zero
  static constexpr int kMostBlocks = (ChebyshevSeries::kMostPoints + kLanes - 1) / kLanes;
  using Values = std::array<double, kLanes * kMostBlocks>;

  /// What follows from the axis and the range alone.
  struct Samples {
    int count = 0;               ///< number of samples (Chebyshev points of the range)
    int blocks = 0;              ///< blocks of four samples
    Values z{};                  ///< sample positions on the range, scaled to [0, 1]
    std::vector<Lanes> rows;     ///< in each block: direction x, y, then the A_r of CollocationRule
    std::vector<double> points;  ///< direction and A_r at each point of quadrature()
    bool exact = true;           ///< interpolating the samples is exact to rounding
    std::vector<std::array<double, 2>> axis;  ///< initial axis at the samples, scaled; with a surface only
  };

  [[nodiscard]] std::shared_ptr<const Samples> sampled() const;
  friend class AheadOfSeam;
  [[nodiscard]] PlaceOnAxis place_at(double xi) const;
  [[nodiscard]] double slope_to_surface(double xi, std::array<double, 2> u, std::array<double, 2> du) const;
  void motions_into(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                    double less, Values& w) const;
  void depths(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
              Values& g) const;
  void penetrations(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                    double depth, Values& g) const;
  [[nodiscard]] bool resolved(const Samples& samples) const;
  void add_bends(std::vector<KnotPlace>& out) const;
  void add_seams(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                 std::vector<KnotPlace>& out) const;
  void add_law_knots(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                     std::vector<KnotPlace>& out) const;
  void laws_at_samples(std::array<Values, 3>& out) const;
  void add_knot(int knot, double sign, const Values& w, const std::array<Values, 3>& laws,
                std::vector<KnotPlace>& out) const;
  /// a + sum_r weights_r (dx_r, dy_r).
  [[nodiscard]] static std::array<double, 2> combined(std::array<double, 2> a,
                                                      std::span<const double> weights,
                                                      std::span<const double> dx, std::span<const double> dy);

  [[nodiscard]] const Direction& direction() const { return foundation_law_.direction; }

  const CollocationRule* rule_;
  FoundationLaw foundation_law_;
  Place place_;
  std::array<double, 2> range_;
  Law law_;
  GroundMotion ground_;
  int foundation_;
  std::shared_ptr<const Samples> samples_;
};

}  // namespace snapthrough
