#pragma once
/// @file
/// The part of a one-sided foundation that lies on one element.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/axis_curve.h"
#include "solver/numeric/chebyshev_series.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/support/law.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// @brief One-sided Winkler foundation on part of an element: reaction K max(g, 0) per undeformed length
/// along -d, with penetration g = u.d - gap and d the direction into the medium.
///
/// Its integrals are split where g changes sign inside the element, so they are C1 in the displacements: a
/// moving contact edge needs no event and gives no false limit points. Immutable, thread safe.
class FoundationContact {
 public:
  /// Where the element lies on its member's initial axis.
  struct Place {
    std::shared_ptr<const AxisCurve> axis;  ///< empty where the direction does not turn with it
    double s0 = 0.0;                        ///< arc length of the element's start, in the axis' own units
    double ds = 0.0;                        ///< arc length over the element, same units
  };
  using Interval = ElementPart;

  /// @param range part of the element, in [0, 1]
  /// @param law its stiffness K times the element's length (a sum of weights times it integrates K ds)
  /// @pre place.axis where the direction turns
  FoundationContact(int order, const Direction& direction, Place place, std::array<double, 2> range,
                    const Law& law, int foundation);

  /// Rule for integrals over a contact interval.
  [[nodiscard]] static Quadrature quadrature(int order) { return gauss_legendre(std::max(order + 2, 5)); }
  /// The same contact with another gap.
  [[nodiscard]] FoundationContact with_gap(double gap) const;
  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] int foundation() const { return foundation_; }
  [[nodiscard]] std::array<double, 2> range() const { return range_; }
  [[nodiscard]] std::array<double, 2> direction_at(double xi) const;

  /// @brief Penetration at xi.
  /// @param ua displacement (x, y) at the element's start; dx, dy: h times u'_x, u'_y at the Gauss points
  [[nodiscard]] double penetration(double xi, std::array<double, 2> ua, std::span<const double> dx,
                                   std::span<const double> dy) const;
  /// @brief d penetration / d xi.
  [[nodiscard]] double penetration_slope(double xi, std::array<double, 2> ua, std::span<const double> dx,
                                         std::span<const double> dy) const;
  /// @brief Whether it is nowhere on the range further from touching than `distance`.
  [[nodiscard]] bool is_near(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                             double distance) const;
  /// @brief Intervals of [0, 1] in contact (g > depth), ascending; `out` is overwritten.
  void contact_intervals(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                         std::vector<Interval>& out, double depth = 0.0) const;

 private:
  /// Something at four of the samples; lanes beyond the last sample are zero.
  using Lanes = Eigen::Array4d;
  static constexpr int kLanes = 4;
  static constexpr int kMostBlocks = (ChebyshevSeries::kMostPoints + kLanes - 1) / kLanes;
  using Values = std::array<double, kLanes * kMostBlocks>;

  void penetrations(std::array<double, 2> ua, std::span<const double> dx, std::span<const double> dy,
                    double gap, Values& g) const;
  [[nodiscard]] bool resolved() const;
  template <class Gap>
  void search(const Gap& gap, const Values& g, std::vector<Interval>& out) const;

  const CollocationRule* rule_;
  Direction direction_;  ///< into the medium
  Place place_;
  std::array<double, 2> range_;
  Law law_;
  int foundation_;
  int count_ = 0;               ///< samples: Chebyshev's points of the range
  int blocks_ = 0;              ///< of them
  bool exact_ = true;           ///< the samples give the penetration between them to rounding
  Values z_{};                  ///< in the range, from 0 to 1
  std::vector<Lanes> samples_;  ///< a block after the other: direction x and y, then A_r for every r
};

}  // namespace snapthrough
