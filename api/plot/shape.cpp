#include "api/plot/shape.h"

#include <charconv>
#include <cmath>
#include <iterator>

#include "api/plot/ink.h"
#include "api/plot/plot_error.h"

namespace snapthrough::api::plot {
namespace {

constexpr char32_t kReplacement = 0xfffd;

const char* anchor_name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

/// Returns whether XML 1.0 allows a character.
bool is_allowed(char32_t point) {
  return point == '\t' || point == '\n' || point == '\r' || (point >= 0x20 && point <= 0xd7ff) ||
         (point >= 0xe000 && point <= 0xfffd) || (point >= 0x10000 && point <= 0x10ffff);
}

/// Returns the code point at `at` and advances; an invalid byte gives kReplacement and advances by one.
char32_t next_point(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at++);
  if (first < 0x80) {
    return first;
  }
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc2 ? 1 : -1;
  if (more < 0 || first > 0xf4 || at + static_cast<std::size_t>(more) > text.size()) {
    return kReplacement;
  }
  char32_t point = first & (0x3fU >> more);
  for (int i = 0; i < more; ++i) {
    const unsigned char next = byte(at + static_cast<std::size_t>(i));
    if ((next & 0xc0U) != 0x80) {
      return kReplacement;
    }
    point = (point << 6U) | (next & 0x3fU);
  }
  constexpr char32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
  if (point < kLeast[more]) {
    return kReplacement;
  }
  at += static_cast<std::size_t>(more);
  return point;
}

void append_escaped(std::string& text, std::string_view raw) {
  for (const char32_t point : code_points(raw)) {
    switch (point) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '"':
        text += "&quot;";
        break;
      case '\'':
        text += "&#39;";
        break;
      case '\r':
        text += "&#13;";
        break;
      default:
        append_utf8(text, point);
    }
  }
}

void append_shape(std::string& text, const Shape& shape) {
  if (shape.name.empty()) {
    append_escaped(text, shape.text);
    return;
  }
  text.append("<").append(shape.name);
  for (const auto& [name, value] : shape.attributes) {
    text.append(" ").append(name).append("=\"");
    append_escaped(text, value);
    text += '"';
  }
  if (shape.children.empty()) {
    text += "/>";
    return;
  }
  text += '>';
  for (const Shape& child : shape.children) {
    append_shape(text, child);
  }
  text.append("</").append(shape.name).append(">");
}

}  // namespace

std::string coordinate(double value) {
  if (!std::isfinite(value)) {
    throw PlotError("", "the figure cannot be drawn: its numbers lie too far apart");
  }
  char digits[400];
  const double rounded = std::round(value * 100) / 100;
  const auto end = std::to_chars(std::begin(digits), std::end(digits), rounded == 0 ? 0.0 : rounded,
                                 std::chars_format::fixed);
  std::string text(std::begin(digits), end.ptr);
  constexpr std::size_t kUsual = 16;  // characters; a figure far outside its frame has longer numbers
  Ink::spend(1 + text.size() / kUsual);
  return text;
}

std::string path_data(std::span<const Pixel> points, bool closed) {
  std::string text;
  bool pen = false;
  for (const auto& [x, y] : points) {
    if (!std::isfinite(x) || !std::isfinite(y)) {
      pen = false;
      continue;
    }
    text.append(pen ? "L" : "M").append(coordinate(x)).append(" ").append(coordinate(y));
    pen = true;
  }
  if (closed && !text.empty()) {
    text += 'Z';
  }
  return text;
}

Shape text_node(std::string text) { return {"", {}, {}, std::move(text)}; }

Shape element(std::string name, std::vector<std::pair<std::string, std::string>> attributes,
              std::vector<Shape> children) {
  return {std::move(name), std::move(attributes), std::move(children), ""};
}

Shape group(std::string_view looks, std::vector<Shape> children) {
  return element("g", {{"class", std::string(looks)}}, std::move(children));
}

Shape line(std::string_view looks, Pixel from, Pixel to) {
  return element("line", {{"class", std::string(looks)},
                          {"x1", coordinate(from.x)},
                          {"y1", coordinate(from.y)},
                          {"x2", coordinate(to.x)},
                          {"y2", coordinate(to.y)}});
}

Shape path_of(std::string_view looks, std::string data) {
  return element("path", {{"class", std::string(looks)}, {"d", std::move(data)}});
}

Shape path(std::string_view looks, std::span<const Pixel> points, bool closed) {
  return path_of(looks, path_data(points, closed));
}

Shape circle(std::string_view looks, Pixel centre, double radius) {
  return element("circle", {{"class", std::string(looks)},
                            {"cx", coordinate(centre.x)},
                            {"cy", coordinate(centre.y)},
                            {"r", coordinate(radius)}});
}

Shape rectangle(std::string_view looks, const Box& box) {
  return element("rect", {{"class", std::string(looks)},
                          {"x", coordinate(box.left)},
                          {"y", coordinate(box.top)},
                          {"width", coordinate(std::max(0.0, box.right - box.left))},
                          {"height", coordinate(std::max(0.0, box.bottom - box.top))}});
}

Shape label_of(std::string_view looks, Pixel at, Anchor anchor, std::vector<Shape> runs) {
  return element("text",
                 {{"class", std::string(looks)},
                  {"x", coordinate(at.x)},
                  {"y", coordinate(at.y)},
                  {"text-anchor", anchor_name(anchor)}},
                 std::move(runs));
}

Shape label(std::string_view looks, Pixel at, Anchor anchor, std::string text) {
  return label_of(looks, at, anchor, {text_node(std::move(text))});
}

Shape upright_label(std::string_view looks, Pixel at, std::string text) {
  Shape shape = label(looks, at, Anchor::middle, std::move(text));
  shape.attributes.emplace_back("transform", "rotate(-90 " + coordinate(at.x) + " " + coordinate(at.y) + ")");
  return shape;
}

void append(std::vector<Shape>& all, std::vector<Shape> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::u32string code_points(std::string_view text) {
  std::u32string points;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t point = next_point(text, at);
    points += is_allowed(point) ? point : kReplacement;
  }
  return points;
}

void append_utf8(std::string& text, char32_t point) {
  const auto put = [&text](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xc0U | (point >> 6U));
    put(0x80U | (point & 0x3fU));
  } else if (point < 0x10000) {
    put(0xe0U | (point >> 12U));
    put(0x80U | ((point >> 6U) & 0x3fU));
    put(0x80U | (point & 0x3fU));
  } else {
    put(0xf0U | (point >> 18U));
    put(0x80U | ((point >> 12U) & 0x3fU));
    put(0x80U | ((point >> 6U) & 0x3fU));
    put(0x80U | (point & 0x3fU));
  }
}

std::string to_text(const Shape& shape) {
  std::string text;
  append_shape(text, shape);
  return text;
}

}  // namespace snapthrough::api::plot
