#pragma once
/// @file
/// A tree of SVG elements, and its conversion to text.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace snapthrough::api::plot {

/// A point of a figure in pixels from its top left corner, y down.
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

/// An SVG element with attributes and children; a Shape without a name is the text node `text`.
struct Shape {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Shape> children;
  std::string text;
};

enum class Anchor { start, middle, end };

/// Returns the text of a coordinate, rounded to 0.01 pixel, and spends it (ink.h).
/// @throws PlotError when the coordinate is not finite, or the figure has too many
[[nodiscard]] std::string coordinate(double value);

/// Returns the `d` attribute of a path; a point that is not finite interrupts the line.
[[nodiscard]] std::string path_data(std::span<const Pixel> points, bool closed = false);

[[nodiscard]] Shape text_node(std::string text);
[[nodiscard]] Shape element(std::string name, std::vector<std::pair<std::string, std::string>> attributes,
                            std::vector<Shape> children = {});
[[nodiscard]] Shape group(std::string_view looks, std::vector<Shape> children);
[[nodiscard]] Shape line(std::string_view looks, Pixel from, Pixel to);
[[nodiscard]] Shape path(std::string_view looks, std::span<const Pixel> points, bool closed = false);
[[nodiscard]] Shape path_of(std::string_view looks, std::string data);
[[nodiscard]] Shape circle(std::string_view looks, Pixel centre, double radius);
/// Returns a rectangle; a box without area gives a rectangle of size zero.
[[nodiscard]] Shape rectangle(std::string_view looks, const Box& box);
[[nodiscard]] Shape label(std::string_view looks, Pixel at, Anchor anchor, std::string text);
[[nodiscard]] Shape label_of(std::string_view looks, Pixel at, Anchor anchor, std::vector<Shape> runs);
/// Returns a label turned by -90 degrees about its centre `at`.
[[nodiscard]] Shape upright_label(std::string_view looks, Pixel at, std::string text);
/// Moves shapes to the end of `all`.
void append(std::vector<Shape>& all, std::vector<Shape> more);

/// @brief Returns the code points of a UTF-8 text. Invalid bytes and characters that XML forbids become
/// U+FFFD.
[[nodiscard]] std::u32string code_points(std::string_view text);
/// Appends a code point in UTF-8.
void append_utf8(std::string& text, char32_t point);

/// Returns the SVG text of a shape and its children, with texts escaped.
[[nodiscard]] std::string to_text(const Shape& shape);

}  // namespace snapthrough::api::plot
