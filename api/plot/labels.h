#pragma once
/// @file
/// Placement of labels: of the positions around its anchor, a label takes the one that covers least.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// Returns an upper estimate of the width of a text in pixels; `size` is the font size in pixels.
[[nodiscard]] double text_width(std::string_view text, double size = 12, bool bold = false);
/// Returns the text, shortened with an ellipsis when text_width() exceeds `width` pixels.
[[nodiscard]] std::string fitted(std::string_view text, double width, double size = 12, bool bold = false);

/// Weight of a box that no label may cover.
inline constexpr int kLabelWeight = 250;

/// @brief Covered area in cells of 4 pixels; a cell holds the largest weight (1 to 255) drawn on it.
class Occupancy {
 public:
  explicit Occupancy(Size size);
  void add_box(const Box& box, int weight = kLabelWeight);
  void add_line(std::span<const Pixel> points, int weight = 8);
  /// Returns the sum of weights in a box; infinity when the box covers a label or leaves the figure.
  [[nodiscard]] double cost(const Box& box) const;

 private:
  void add(double column, double row, int weight);

  Size size_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<std::uint8_t> weight_;
};

/// A piece of a label with its CSS class; a space separates pieces.
struct Run {
  std::string text;
  std::string looks;
  bool bold = false;
};

struct LabelRequest {
  Pixel at;
  std::vector<Run> runs;
  std::string looks;
  double distance = 6;    ///< distance from the anchor in pixels
  int prefer = 7;         ///< preferred direction: 0 right, then clockwise in steps of 45 degrees
  bool leader = false;    ///< a line joins the anchor and a label beyond the first ring
  int rings = 4;          ///< number of rings around the anchor to try; 1 keeps the label at the anchor
  double tolerance = 60;  ///< labels whose cheapest position costs more are left out
};

/// Draws a label at its cheapest position and adds its box to `taken`; nullopt above the tolerance.
[[nodiscard]] std::optional<Shape> place_label(const LabelRequest& request, Occupancy& taken);

}  // namespace snapthrough::api::plot
