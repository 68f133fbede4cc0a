#pragma once
/// @file
/// All solutions of a column's differential equation that satisfy the conditions on its left, carried along
/// it.
///
/// Left of any place these form a plane of states (w, w', V, M), spanned by the two columns of a frame. V and
/// M are the force and moment that the part on the left has to be given there: with S its stiffness,
/// (V, M) = S (w, w'). Frames are carried through pieces by the equation's exact transfer matrix and made
/// orthonormal again. Unlike S, which becomes infinite where the part on the left, clamped at the place,
/// buckles, a frame has no singular states, so nothing loses digits at any load.

#include <array>
#include <vector>

#include "solver/column/column_line.h"

namespace snapthrough {

using Matrix2 = std::array<std::array<double, 2>, 2>;

/// Rows w, w', V, M; two columns.
struct ColumnFrame {
  std::array<std::array<double, 2>, 4> rows{};
};

/// A number that may leave the range of double: mantissa times 2^exponent.
struct WideNumber {
  double mantissa = 1.0;
  int exponent = 0;
};

struct ColumnCount {
  int negative = 0;  ///< negative eigenvalues of the lateral stiffness: how many buckling loads are below
  /// A function of the load that is smooth, whatever the pieces, and zero at the buckling loads only.
  WideNumber determinant;
};

/// Part of a span over which states grow little, with its frames, for finding modes.
struct ColumnPiece {
  int span = 0;
  double from = 0.0;  ///< in the span, scaled
  double length = 0.0;
  double q = 0.0;  ///< (P - G) / EI
  double r = 0.0;  ///< K / EI
  double EI = 1.0;
  ColumnFrame start;       ///< right of the joint that the piece begins at
  ColumnFrame end;         ///< left of the joint that it ends at
  Matrix2 start_from_end;  ///< coordinates in `start` from those in `end`
  Matrix2 end_from_next;   ///< coordinates in `end` from those in the next piece's `start`
};

/// @brief How many pieces a load needs, all spans together.
[[nodiscard]] double piece_count(const ColumnLine& line, double lambda);

/// @brief Counts the buckling loads below a load factor (Wittrick and Williams, Q. J. Mech. Appl. Math. 24,
/// 1971, on pieces too short to buckle clamped).
/// @param cut_finer more pieces than are needed: other rounding errors
/// @throws Cancelled when the line's stop token was asked to stop
[[nodiscard]] ColumnCount count_below(const ColumnLine& line, double lambda, bool cut_finer = false);

/// @brief The pieces with their frames at a load factor.
[[nodiscard]] std::vector<ColumnPiece> pieces_at(const ColumnLine& line, double lambda);

}  // namespace snapthrough
