#pragma once
/// @file
/// Straight columns with axial prestress only, as their exact solution needs them.

#include <array>
#include <optional>
#include <stop_token>
#include <vector>

#include "solver/model/model.h"

namespace snapthrough {

/// A length of the column on which nothing changes, scaled: EI w'''' + (P - G) w'' + K w = 0 with
/// P = constant + lambda proportional.
struct ColumnSpan {
  double length = 0.0;
  double EI = 1.0;
  double foundation = 0.0;    ///< K, sum of the foundations
  double layer = 0.0;         ///< G, sum of their shear layers
  double constant = 0.0;      ///< compression by the constant actions
  double proportional = 0.0;  ///< by unit load factor
  int member = 0;
  std::array<double, 2>
      fractions{};  ///< of the member at the span's two ends; falling when it runs backwards
};

/// What acts on the rotation beside a joint, scaled.
struct ColumnSide {
  double spring = 0.0;
  bool held = false;
};

/// A place between two spans, or an end, scaled. The rotations on its two sides differ where it is a hinge.
struct ColumnJoint {
  double spring = 0.0;  ///< lateral
  bool held = false;    ///< laterally
  bool hinge = false;
  ColumnSide left;   ///< unused at the first joint
  ColumnSide right;  ///< unused at the last joint
};

/// @brief Members in one line. Lengths are over `length`, stiffnesses EI over `stiffness`, and all else
/// accordingly (forces over EI / length^2). Displacements w are along `normal`, rotations w'.
struct ColumnLine {
  double length = 1.0;
  double stiffness = 1.0;
  std::array<double, 2> normal{};
  std::vector<ColumnSpan> spans;
  std::vector<ColumnJoint> joints;  ///< one more than there are spans
  std::stop_token stop;             ///< who computes with it looks at this
};

/// @brief Reads a model as a column: members in one straight line, one after another, unshearable and
/// perfect, with bilateral lateral foundations, springs and supports along or across it, and actions that
/// compress or stretch it only, by forces that are constant between places.
///
/// Two or more elastic springs along the line, or one beside supports, are not among these.
/// @return empty when the model is anything else
/// @pre the model passed check()
[[nodiscard]] std::optional<ColumnLine> column_line(const Model& model);

/// @brief The same column seen from its other end: w is kept, rotations change their sign.
[[nodiscard]] ColumnLine reversed(const ColumnLine& line);

}  // namespace snapthrough
