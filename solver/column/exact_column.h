#pragma once
/// @file
/// Buckling loads and modes of straight columns from their differential equation, without a mesh.

#include <array>
#include <optional>
#include <vector>

#include "solver/column/column_line.h"

namespace snapthrough {

/// Buckling loads of a column, ascending, as load factors of its model.
struct ColumnBuckling {
  std::vector<double> loads;  ///< fewer than asked for when there are no more
  /// Relative, one a load: inertia counts with other rounding errors put the load within this of the value.
  std::vector<double> errors;
  int negative_at_start = 0;  ///< negative eigenvalues under the constant actions alone
  int counts = 0;             ///< how often the column was gone through
};

/// @brief The lowest `count` buckling loads above zero.
///
/// Counts isolate the loads, so that none is missed and repeated ones count as often as they are; the zeros
/// of the determinant between two counts are found by inverse quadratic interpolation with bisection
/// (Chandrupatla, Adv. Eng. Software 28, 1997).
/// @return empty when it can't be done to rounding: far too many half waves, or counts that contradict one
/// another
[[nodiscard]] std::optional<ColumnBuckling> column_buckling(const ColumnLine& line, int count);

class ModeSearch;

/// @brief A buckling mode.
class ColumnMode {
 public:
  struct Value {
    double w = 0.0;      ///< along the line's normal
    double slope = 0.0;  ///< by scaled length
  };
  /// @param x in the span, scaled
  [[nodiscard]] Value at(int span, double x) const;

 private:
  friend class ModeSearch;
  static constexpr int kCoefficients = 28;
  /// The displacement is a power series about one end of each piece.
  struct Piece {
    double from = 0.0;
    double length = 0.0;
    double direction = 1.0;  ///< 1: about its start, -1: about its end
    std::array<double, kCoefficients> coefficients{};
  };
  std::vector<Piece> pieces_;
  std::vector<int> first_;  ///< piece of each span; one entry more
};

/// @brief The modes of loads that column_buckling() gave, in their order; equal loads get as many independent
/// modes.
///
/// Solutions from the left and from the right are matched where they fit best, which is where the mode is
/// large. They are followed from there to both ends, the way they decay.
/// @return fewer than there are loads when equal loads' modes can't be told apart
[[nodiscard]] std::vector<ColumnMode> column_modes(const ColumnLine& line, const std::vector<double>& loads);

}  // namespace snapthrough
