#pragma once
/// @file
/// A tree of SVG shapes and its text.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace snapthrough::api::plot {

/// A place in a figure, in pixels from its top left corner, y down.
struct Pixel {
  double x = 0;
  double y = 0;
};

/// Width and height in pixels.
struct Size {
  double width = 0;
  double height = 0;
};

struct Box {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
};

/// An element with its attributes and children; without a name it is `text`.
struct Shape {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Shape> children;
  std::string text;
};

enum class Anchor { start, middle, end };

/// A coordinate as it is written, to a hundredth of a pixel.
/// @throws PlotError when it is not finite
[[nodiscard]] std::string coordinate(double value);

/// The `d` of a path through points; what is not finite breaks the line.
[[nodiscard]] std::string path_data(std::span<const Pixel> points, bool closed = false);

[[nodiscard]] Shape text_node(std::string text);
[[nodiscard]] Shape element(std::string name, std::vector<std::pair<std::string, std::string>> attributes,
                            std::vector<Shape> children = {});
[[nodiscard]] Shape group(std::string_view looks, std::vector<Shape> children);
[[nodiscard]] Shape line(std::string_view looks, Pixel from, Pixel to);
[[nodiscard]] Shape path(std::string_view looks, std::span<const Pixel> points, bool closed = false);
[[nodiscard]] Shape path_of(std::string_view looks, std::string data);
[[nodiscard]] Shape circle(std::string_view looks, Pixel centre, double radius);
/// A rectangle; nothing is drawn where the box has no area.
[[nodiscard]] Shape rectangle(std::string_view looks, const Box& box);
[[nodiscard]] Shape label(std::string_view looks, Pixel at, Anchor anchor, std::string text);
[[nodiscard]] Shape label_of(std::string_view looks, Pixel at, Anchor anchor, std::vector<Shape> runs);
/// A label that reads upwards, centred at a place.
[[nodiscard]] Shape upright_label(std::string_view looks, Pixel at, std::string text);
/// Appends copies.
void append(std::vector<Shape>& all, std::vector<Shape> more);

/// @brief Code points of a text. Bytes that are no UTF-8 and characters that XML does not allow become
/// U+FFFD.
[[nodiscard]] std::u32string code_points(std::string_view text);
/// Appends one code point as UTF-8.
void append_utf8(std::string& text, char32_t point);

/// The shape as SVG text, escaped.
[[nodiscard]] std::string to_text(const Shape& shape);

}  // namespace snapthrough::api::plot
