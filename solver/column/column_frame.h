#pragma once
/// @file
/// Transfer of boundary conditions along a column by its differential equation.
///
/// The solutions that satisfy the conditions left of a place form a plane of states (w, w', V, M), spanned by
/// the two columns of a frame. V and M are the force and moment applied to the left part there: (V, M) = S
/// (w, w') with its stiffness S. Frames are transferred exactly through pieces of constant coefficients and
/// orthonormalised. S becomes infinite where the left part, clamped at the place, buckles; a frame stays
/// regular and accurate at any load.

#include <array>
#include <vector>

#include "solver/column/column_line.h"

namespace snapthrough {

using Matrix2 = std::array<std::array<double, 2>, 2>;

/// Rows w, w', V, M; two columns.
struct ColumnFrame {
  std::array<std::array<double, 2>, 4> rows{};
};

/// Number mantissa * 2^exponent that may exceed the range of double.
struct WideNumber {
  double mantissa = 1.0;
  int exponent = 0;
};

struct ColumnCount {
  /// Number of negative eigenvalues of the lateral stiffness: buckling loads below the load factor.
  int negative = 0;
  /// Smooth function of the load factor, independent of the pieces, whose zeros are the buckling loads.
  WideNumber determinant;
};

/// Part of a span, short enough that states grow little over it, with its frames; used to find modes.
struct ColumnPiece {
  int span = 0;
  double from = 0.0;  ///< scaled position in the span
  double length = 0.0;
  double q = 0.0;  ///< coefficient (P - G) / EI of w''
  double r = 0.0;  ///< coefficient K / EI of w
  double EI = 1.0;
  ColumnFrame start;       ///< frame right of the joint at the piece's start
  ColumnFrame end;         ///< frame left of the joint at the piece's end
  Matrix2 start_from_end;  ///< map from coordinates in `end` to those in `start`
  Matrix2 end_from_next;   ///< map from coordinates in the next piece's `start` to those in `end`
};

/// @brief Number of pieces that all spans need at a load factor.
[[nodiscard]] double piece_count(const ColumnLine& line, double lambda);

/// @brief Counts the buckling loads below a load factor (Wittrick and Williams, Q. J. Mech. Appl. Math. 24,
/// 1971), on pieces too short to buckle with clamped ends.
/// @param cut_finer uses more pieces than necessary, which changes the rounding errors
/// @throws Cancelled when the line's stop token was asked to stop
[[nodiscard]] ColumnCount count_below(const ColumnLine& line, double lambda, bool cut_finer = false);

/// @brief Pieces with their frames at a load factor.
[[nodiscard]] std::vector<ColumnPiece> pieces_at(const ColumnLine& line, double lambda);

}  // namespace snapthrough
