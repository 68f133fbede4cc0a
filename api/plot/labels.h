#pragma once
/// @file
/// Labels that never collide: each is tried around its anchor and takes the place that covers least.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// Estimated width of a text in pixels: generous, since there are no fonts to measure it with.
[[nodiscard]] double text_width(std::string_view text, double size = 12, bool bold = false);
/// The text, or as much of its beginning as fits with an ellipsis.
[[nodiscard]] std::string fitted(std::string_view text, double width, double size = 12, bool bold = false);

/// Text of a box that no label may cover.
inline constexpr int kLabelWeight = 250;

/// @brief How much is drawn where, in cells of 4 pixels. Marks, lines and labels add their weight, 1 to 255.
class Occupancy {
 public:
  explicit Occupancy(Size size);
  void add_box(const Box& box, int weight = kLabelWeight);
  void add_line(std::span<const Pixel> points, int weight = 8);
  /// What a box would cover; infinite where it covers a label or leaves the figure.
  [[nodiscard]] double cost(const Box& box) const;

 private:
  void add(double column, double row, int weight);

  Size size_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<std::uint8_t> weight_;
};

/// A piece of a label with its looks; a space stands between pieces.
struct Run {
  std::string text;
  std::string looks;
  bool bold = false;
};

struct LabelRequest {
  Pixel at;
  std::vector<Run> runs;
  std::string looks;
  double distance = 6;    ///< free distance from the anchor
  int prefer = 7;         ///< 0: right, then clockwise by eighths of a turn; 7: above on the right
  bool leader = false;    ///< a line leads to a label that finds its place far away
  int rings = 4;          ///< rings around the anchor that are tried; 1 keeps the label beside its anchor
  double tolerance = 60;  ///< weight that it may cover; labels that cover more are left out
};

/// Writes a label where it covers least, and takes the place; nothing when there is none.
[[nodiscard]] std::optional<Shape> place_label(const LabelRequest& request, Occupancy& taken);

}  // namespace snapthrough::api::plot
