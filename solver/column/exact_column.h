#pragma once
/// @file
/// Buckling loads and modes of straight columns from their differential equation, without a mesh.

#include <array>
#include <optional>
#include <vector>

#include "solver/column/column_line.h"

namespace snapthrough {

/// Buckling loads of a column, ascending, as load factors of the model.
struct ColumnBuckling {
  std::vector<double> loads;  ///< load factors, ascending; fewer than requested when no more exist
  /// Relative, one per load: inertia counts with different rounding errors place the load within this
  /// distance.
  std::vector<double> errors;
  int negative_at_start = 0;  ///< negative eigenvalues under the constant actions alone
  int counts = 0;             ///< number of inertia counts
};

/// @brief Computes the lowest `count` buckling loads above zero.
///
/// Inertia counts isolate all loads with their multiplicity. Zeros of the determinant between two counts are
/// found by inverse quadratic interpolation with bisection (Chandrupatla, Adv. Eng. Software 28, 1997).
/// @return empty when rounding prevents the solution (too many half waves, or contradictory counts)
[[nodiscard]] std::optional<ColumnBuckling> column_buckling(const ColumnLine& line, int count);

class ModeSearch;

/// @brief Buckling mode of a column.
class ColumnMode {
 public:
  struct Value {
    double w = 0.0;      ///< displacement along the line's normal
    double slope = 0.0;  ///< derivative of w with respect to scaled length
  };
  /// @param x scaled position in the span
  [[nodiscard]] Value at(int span, double x) const;

 private:
  friend class ModeSearch;
  static constexpr int terms = 28;  ///< terms of the power series
  /// Power series of the displacement about one end of a piece.
  struct Piece {
    double from = 0.0;
    double length = 0.0;
    double direction = 1.0;  ///< 1: series about the piece's start, -1: about the piece's end
    std::array<double, terms> coefficients{};
  };
  std::vector<Piece> pieces_;
  std::vector<int> first_;  ///< index of each span's first piece; one entry more than spans
};

/// @brief Modes of the loads from column_buckling(), in their order; equal loads get independent modes.
///
/// Solutions from both ends are matched where they agree best, which is where the mode is large, and are
/// followed from there to both ends, in the directions in which they decay.
/// @return fewer modes than loads when those of equal loads cannot be separated
[[nodiscard]] std::vector<ColumnMode> column_modes(const ColumnLine& line, const std::vector<double>& loads);

}  // namespace snapthrough
