#pragma once
/// @file
/// Bound of the number of coordinates of a figure, and with it of its memory and the size of its text.

#include <cstddef>

namespace snapthrough::api::plot {

/// @brief While it lives, the figure that this thread draws may have a number of coordinates.
///
/// What writes a coordinate spends it; what collects points before they are written requires room for them.
/// Both poll WorkLimit (solver/numeric/work_limit.h), because the loops of figures write or collect points.
/// Bounds nest: the innermost one holds.
class Ink {
 public:
  explicit Ink(std::size_t most);
  ~Ink();
  Ink(const Ink&) = delete;
  Ink& operator=(const Ink&) = delete;
  Ink(Ink&&) = delete;
  Ink& operator=(Ink&&) = delete;

  /// Counts coordinates. @throws PlotError when the figure has too many
  static void spend(std::size_t coordinates);
  /// @throws PlotError when the figure has no room for so many more coordinates
  static void require(std::size_t coordinates);

 private:
  std::size_t most_;
  std::size_t left_;
  Ink* outer_;
};

}  // namespace snapthrough::api::plot
