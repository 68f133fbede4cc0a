#pragma once
/// @file
/// Charts: places of one or two parameters at which a value is computed so that straight lines between them
/// are near enough to it.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snapthrough {

/// What a chart shows at one place.
struct ChartValue {
  std::optional<double> value;  ///< empty: there is none
  std::string kind;             ///< places of different kinds are not joined, even where their values agree
};

/// Places of a parameter: 0 to `intervals`. The search begins with `first` equal parts.
/// @pre intervals / first is a power of two
struct ChartAxis {
  int intervals = 1;
  int first = 1;
};

struct ChartLimits {
  /// Largest distance of a straight line from the value, as a share of the value. Values below a hundredth of
  /// the largest one count as that hundredth.
  double within = 0.01;
  std::size_t most = 1000;  ///< largest number of places
};

/// Two neighbouring places between which a search ended early.
using ChartGap = std::pair<int, int>;

/// Places of a curve in rising order.
struct ChartCurve {
  std::vector<int> places;
  std::vector<ChartValue> values;
  /// Number of the piece of each place, from 0. A new piece begins where the kind changes, where values begin
  /// or end, and at a jump. A single place without value right between two others belongs to the piece
  /// before.
  std::vector<int> pieces;
  /// Whether the value changes by more than the share `within` from the place before, which is the next one
  /// of the axis. Of several such changes within eight places the largest one is a jump, and none beside a
  /// change of kind.
  std::vector<bool> jumps = {};
  std::optional<ChartGap> unfinished = {};  ///< set when `most` places were not enough

  /// Returns the number of pieces.
  [[nodiscard]] int count() const { return pieces.empty() ? 0 : pieces.back() + 1; }
};

/// @brief Chooses places along one parameter.
///
/// An interval whose middle lies within half of `within` of the straight line is kept, an interval that the
/// search began with only if its first quarter does so too; others are halved. Intervals whose lines meet at
/// an angle that a bent curve would have are looked into once more. Changes of kind and jumps are so enclosed
/// by two neighbouring places of the axis. A feature narrower than the first intervals can be missed.
/// @param value called once for each place; exceptions pass through
[[nodiscard]] ChartCurve chart_curve(const std::function<ChartValue(int)>& value, const ChartAxis& axis,
                                     const ChartLimits& limits);

/// Curves along the inner parameter at places of the outer one, in rising order.
struct ChartSurface {
  std::vector<int> places;
  std::vector<ChartCurve> curves;
  std::optional<ChartGap> unfinished = {};  ///< places of the outer parameter; see ChartCurve
};

/// @brief Returns the value of a surface between two of its curves.
///
/// Where both curves have the same number of pieces, piece k reaches from the blend of its first places to
/// the blend of its last ones, and values are blended at the same share of its length. Otherwise values are
/// blended at the same place.
/// @param share 0 at `before`, 1 at `after`
/// @return nothing between two pieces, and where a curve has no value
[[nodiscard]] std::optional<double> between_curves(const ChartCurve& before, const ChartCurve& after,
                                                   double share, double place);

/// @brief Chooses places of two parameters: curves along the inner one, with half of `within` for their
/// straight lines and half for between_curves().
///
/// Halfway between two curves the ends of pieces are off by at most 0.05 % of the inner axis. Five values of
/// each first quarter are only compared. `limits.most` bounds all values together.
[[nodiscard]] ChartSurface chart_surface(const std::function<ChartValue(int outer, int inner)>& value,
                                         const ChartAxis& outer, const ChartAxis& inner,
                                         const ChartLimits& limits);

}  // namespace snapthrough
