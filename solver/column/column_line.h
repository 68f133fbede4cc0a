#pragma once
/// @file
/// Straight columns with axial prestress only, as input to their exact solution.

#include <array>
#include <optional>
#include <stop_token>
#include <vector>

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Part of the column with constant coefficients, scaled: EI w'''' + (P - G) w'' + K w = 0 with
/// P = constant + lambda proportional.
struct ColumnSpan {
  double length = 0.0;
  double EI = 1.0;
  double foundation = 0.0;    ///< K, sum over the foundations
  double layer = 0.0;         ///< G, sum over the shear layers
  double constant = 0.0;      ///< compression by the constant actions
  double proportional = 0.0;  ///< compression per unit load factor
  int member = 0;
  std::array<double, 2> fractions{};  ///< member fractions at both ends; falling if the member runs backwards
};

/// Rotational restraint beside a joint, scaled.
struct ColumnSide {
  double spring = 0.0;
  bool held = false;
};

/// Joint between two spans, or a column end, scaled. At a hinge the rotations on both sides differ.
struct ColumnJoint {
  double spring = 0.0;  ///< lateral stiffness
  bool held = false;    ///< lateral displacement is fixed
  bool hinge = false;
  ColumnSide left;   ///< unused at the first joint
  ColumnSide right;  ///< unused at the last joint
};

/// @brief Members in one line. Lengths are divided by `length`, EI by `stiffness`, forces by EI / length^2.
/// Displacements w are along `normal`, rotations are w'.
struct ColumnLine {
  double length = 1.0;
  double stiffness = 1.0;
  std::array<double, 2> normal{};
  std::vector<ColumnSpan> spans;
  std::vector<ColumnJoint> joints;  ///< ends and places between spans; one more than spans
  std::stop_token stop;             ///< cancels computations on the line
};

/// @brief Reads a model as a column: unshearable perfect members in one straight line, with bilateral
/// foundations, springs and supports along or across the line, and actions that cause axial forces only,
/// constant between joints. At most one elastic spring may act along the line, and only without rigid
/// supports in that direction.
/// @return empty for any other model
/// @pre the model passed check()
[[nodiscard]] std::optional<ColumnLine> column_line(const ResolvedModel& model);

/// @brief The column with both ends exchanged: w is kept, rotations change sign.
[[nodiscard]] ColumnLine reversed(const ColumnLine& line);

}  // namespace snapthrough
