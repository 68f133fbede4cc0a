#pragma once
/// @file
/// Places at which the curves of a refined sweep break, with the names of what changes there.

#include <string>
#include <vector>

#include "api/plot/shape.h"
#include "api/plot/table.h"

namespace snapthrough::api::plot {

/// Two neighbouring rows of a curve that no line joins.
struct SweepBreak {
  Pixel before;        ///< without a finite y where the row has no value
  Pixel after;         ///< likewise
  std::string change;  ///< what changes; "" where the table does not say it
};

/// Returns whether two neighbouring rows of a curve belong to different pieces. @pre rows of the table
[[nodiscard]] bool is_break(const Table& table, std::size_t before, std::size_t after);
/// Returns what changes between two neighbouring rows. @pre is_break()
[[nodiscard]] std::string change_at(const Table& table, std::size_t before, std::size_t after);

/// Returns a sentence for the description of a figure; "" without breaks.
[[nodiscard]] std::string breaks_text(const std::vector<SweepBreak>& breaks);

/// @brief Draws a ring at both ends of each break, and up to six names where they cover nothing: the first
/// break of each change before others.
/// @param curves places that names keep away from
/// @param inside box that names do not leave: that of the axes
[[nodiscard]] Shape breaks_shape(const std::vector<SweepBreak>& breaks,
                                 const std::vector<std::vector<Pixel>>& curves, Size size, const Box& inside);

}  // namespace snapthrough::api::plot
