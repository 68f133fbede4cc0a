#pragma once
/// @file
/// Reads an SVG text as strictly as XML asks, and finds places in it as a person does: by the numbers at the
/// ticks of the axes.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace snapthrough::testing {

struct SvgElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;             ///< of the element and of what is in it
  std::vector<std::string> of;  ///< looks of the elements around it, outermost first

  [[nodiscard]] std::string attribute(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? "" : found->second;
  }
  [[nodiscard]] double number(const std::string& key) const { return std::stod(attributes.at(key)); }
  /// Whether it has this word among its looks.
  [[nodiscard]] bool is(const std::string& looks) const {
    return (" " + attribute("class") + " ").find(" " + looks + " ") != std::string::npos;
  }
};

/// @brief A strict reader of the XML that figures are written in: no comments, sections or processing
/// instructions but the first line. Throws std::runtime_error where a text is not well-formed.
class SvgReader {
 public:
  explicit SvgReader(std::string_view text) : text_(text) {
    constexpr std::string_view kHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    need(text_.starts_with(kHead), "the XML declaration");
    check_characters();
    at_ = kHead.size();
    read_element();
    need(text_.substr(at_) == "\n", "one root and a line feed");
  }

  [[nodiscard]] const std::vector<SvgElement>& elements() const { return elements_; }

  [[nodiscard]] std::vector<SvgElement> with(const std::string& looks) const {
    std::vector<SvgElement> found;
    std::copy_if(elements_.begin(), elements_.end(), std::back_inserter(found),
                 [&](const SvgElement& one) { return one.is(looks); });
    return found;
  }
  /// Texts of all labels in the order of the figure.
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> all;
    for (const SvgElement& one : elements_) {
      if (one.name == "text") {
        all.push_back(one.text);
      }
    }
    return all;
  }

 private:
  void need(bool holds, const std::string& what) const {
    if (!holds) {
      throw std::runtime_error("not well-formed at byte " + std::to_string(at_) + ": needs " + what +
                               ", is " + std::string(text_.substr(at_, 60)));
    }
  }
  /// UTF-8, and no character that XML does not allow.
  void check_characters() {
    for (std::size_t i = 0; i < text_.size();) {
      const auto first = static_cast<unsigned char>(text_[i]);
      const std::size_t more = first < 0x80 ? 0 : first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
      need(first >= 0x20 || first == '\n' || first == '\t', "no control characters");
      need(first < 0x80 || (first >= 0xc2 && first <= 0xf4), "UTF-8");
      for (std::size_t k = 1; k <= more; ++k) {
        need(i + k < text_.size() && (static_cast<unsigned char>(text_[i + k]) & 0xc0U) == 0x80, "UTF-8");
      }
      need(text_.substr(i, 3) != "\xef\xbf\xbe" && text_.substr(i, 3) != "\xef\xbf\xbf", "characters of XML");
      need(first != 0xed || static_cast<unsigned char>(text_[i + 1]) < 0xa0, "no surrogates");
      i += more + 1;
    }
  }
  std::string read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '-')) {
      ++at_;
    }
    need(at_ > begin, "a name");
    return std::string(text_.substr(begin, at_ - begin));
  }
  std::string unescaped(std::string_view raw) {
    static const std::map<std::string, std::string> kEntities = {{"amp", "&"},   {"lt", "<"},  {"gt", ">"},
                                                                 {"quot", "\""}, {"#39", "'"}, {"#13", "\r"}};
    std::string text;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      need(raw[i] != '<' && raw[i] != '>', "escaped brackets");
      if (raw[i] != '&') {
        text += raw[i];
        continue;
      }
      const std::size_t end = raw.find(';', i);
      need(end != std::string_view::npos, "an entity");
      const auto found = kEntities.find(std::string(raw.substr(i + 1, end - i - 1)));
      need(found != kEntities.end(), "a known entity");
      text += found->second;
      i = end;
    }
    return text;
  }
  void read_attributes(SvgElement& element) {
    while (text_[at_] == ' ') {
      ++at_;
      const std::string name = read_name();
      need(text_.substr(at_, 2) == "=\"", "a quoted value");
      at_ += 2;
      const std::size_t end = text_.find('"', at_);
      need(end != std::string_view::npos, "the end of a value");
      const std::string value = unescaped(text_.substr(at_, end - at_));
      need(element.attributes.emplace(name, value).second, "an attribute once");
      at_ = end + 1;
    }
  }
  void read_element() {
    need(text_.substr(at_, 1) == "<", "an element");
    ++at_;
    const std::size_t index = elements_.size();
    elements_.emplace_back();
    SvgElement element;
    element.name = read_name();
    element.of = around_;
    read_attributes(element);
    elements_[index] = element;
    if (text_.substr(at_, 2) == "/>") {
      at_ += 2;
      return;
    }
    need(text_.substr(at_, 1) == ">", "the end of a tag");
    ++at_;
    around_.push_back(element.attribute("class"));
    while (text_.substr(at_, 2) != "</") {
      need(at_ < text_.size(), "a closing tag");
      if (text_[at_] == '<') {
        const std::size_t child = elements_.size();
        read_element();
        elements_[index].text += elements_[child].text;
      } else {
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        elements_[index].text += unescaped(text_.substr(at_, end - at_));
        at_ = end;
      }
    }
    around_.pop_back();
    at_ += 2;
    need(read_name() == element.name, "the closing tag of " + element.name);
    need(text_.substr(at_, 1) == ">", "the end of a tag");
    ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<SvgElement> elements_;
  std::vector<std::string> around_;
};

/// The number that a figure writes; NaN for another text.
inline double written_number(std::string text) {
  const auto replace = [&text](const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
      text.replace(at, what.size(), by);
    }
  };
  replace("\u202f\u00d7\u202f10", "e");
  if (text.starts_with("10\u207b") || text.starts_with("\u221210\u207b") || text.starts_with("10\u2070") ||
      text.find("10\u00b9") == 0 || text.find("10\u2074") == 0 || text.find("10\u2076") == 0 ||
      text.find("10\u2077") == 0) {
    replace("10", "1e");
  }
  replace("\u202f", "");
  replace("\u2212", "-");
  replace("\u207b", "-");
  const char* digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                          "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  for (int i = 0; i < 10; ++i) {
    replace(digits[i], std::to_string(i));
  }
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size() && !text.empty() ? value : std::nan("");
}

/// An axis as a reader sees it: the first and the last tick with their numbers.
struct ReadAxis {
  double first = 0, first_pixel = 0, last = 0, last_pixel = 0;

  [[nodiscard]] double pixel(double value, bool logarithmic = false) const {
    const double share =
        logarithmic ? std::log(value / first) / std::log(last / first) : (value - first) / (last - first);
    return first_pixel + share * (last_pixel - first_pixel);
  }
};

/// The axes of a chart by its tick labels: those of the horizontal one are centred, of the vertical one end
/// at the axis.
/// @param svg a figure, or a part of one that finds elements by their looks
template <class Elements>
std::pair<ReadAxis, ReadAxis> read_axes(const Elements& svg) {
  std::pair<ReadAxis, ReadAxis> axes;
  bool first_x = true;
  bool first_y = true;
  for (const SvgElement& tick : svg.with("tick")) {
    const bool is_x = tick.attribute("text-anchor") == "middle";
    const bool is_y = tick.attribute("text-anchor") == "end";
    if (!is_x && !is_y) {
      continue;
    }
    ReadAxis& axis = is_x ? axes.first : axes.second;
    bool& first = is_x ? first_x : first_y;
    axis.last = written_number(tick.text);
    axis.last_pixel = is_x ? tick.number("x") : tick.number("y") - 4;  // the text's base line
    if (first) {
      axis.first = axis.last;
      axis.first_pixel = axis.last_pixel;
      first = false;
    }
  }
  return axes;
}

/// Places of a path's `d`.
inline std::vector<std::pair<double, double>> read_points(const std::string& d) {
  std::vector<std::pair<double, double>> points;
  const char* at = d.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    if (*at == 'M' || *at == 'L') {
      const double x = std::strtod(at + 1, &end);
      at = end;
      const double y = std::strtod(at, &end);
      points.emplace_back(x, y);
      at = end;
    } else {
      ++at;
    }
  }
  return points;
}

}  // namespace snapthrough::testing
