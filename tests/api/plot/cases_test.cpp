/// The figures that both drawing libraries share: tests/figures/cases.json says what each must show,
/// tests/web/figures/cases.test.ts reads the same list. A fact is read from the picture as a person does, by
/// the numbers at its axes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "api/plot/plot.h"
#include "api/plot/plot_request.h"
#include "tests/api/plot/svg_reader.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using testing::ReadAxis;
using testing::SvgElement;
using testing::SvgReader;
using Place = std::pair<double, double>;
using Piece = std::vector<Place>;

json read_file(const std::string& name) {
  std::ifstream file(std::string(SNAPTHROUGH_SOURCE_DIR) + "/tests/figures/" + name);
  return json::parse(file);
}

const json& cases() {
  static const json list = read_file("cases.json");
  return list;
}

/// Pixels that a mark, or a point of a line, may be off.
double tolerance(const char* what) { return cases().at("tolerance").at(what); }

/// A document of a case: inside of it, or in the file beside the list that it names; null without one.
json document_of(const json& one, const char* key) {
  const json given = one.value(key, json());
  return given.is_string() ? read_file(given.get<std::string>()) : given;
}

/// A fact that the picture does not meet.
class Unmet : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void need(bool holds, const std::string& otherwise) {
  if (!holds) {
    throw Unmet(otherwise);
  }
}

std::string text_of(const Place& place) {
  return "(" + std::to_string(place.first) + ", " + std::to_string(place.second) + ")";
}

std::string plain_spaces(std::string text) {
  for (const std::string space : {"\u00a0", "\u202f"}) {
    for (std::size_t at = text.find(space); at != std::string::npos; at = text.find(space, at)) {
      text.replace(at, space.size(), " ");
    }
  }
  return text;
}

double apart(const Place& a, const Place& b) { return std::hypot(a.first - b.first, a.second - b.second); }

/// Pieces of a path's `d` as places in pixels.
std::vector<Piece> pieces_of(const SvgElement& path) {
  std::vector<Piece> pieces;
  const std::string d = path.attribute("d");
  for (std::size_t at = d.find('M'); at != std::string::npos;) {
    const std::size_t next = d.find('M', at + 1);
    pieces.push_back(testing::read_points(d.substr(at, next == std::string::npos ? next : next - at)));
    at = next;
  }
  return pieces;
}

double distance_to(const Piece& line, const Place& to) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto& [ax, ay] = line[i == 0 ? 0 : i - 1];
    const auto& [bx, by] = line[i];
    const double square = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
    const double along = (to.first - ax) * (bx - ax) + (to.second - ay) * (by - ay);
    const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
    least = std::min(least, apart(to, {ax + t * (bx - ax), ay + t * (by - ay)}));
  }
  return least;
}

Place centre_of(const SvgElement& circle) { return {circle.number("cx"), circle.number("cy")}; }

struct Mark {
  std::string kind;
  Place at;
};

/// Where the first corner of a mark stands from its middle.
struct MarkForm {
  const char* kind;
  const char* looks;
  Place corner;
};
constexpr MarkForm kForms[] = {
    {"bifurcation", "bifurcation", {0, -7}}, {"broken_bifurcation", "broken", {0, -7}},
    {"flutter", "flutter", {-6, -6.5}},      {"softest", "softest", {-5, -5}},
    {"limit_max", "limit", {0, -6.5}},       {"limit_min", "limit", {0, 6.5}},
    {"capacity", "limit", {-6, -5}},         {"first_yield", "yield", {-4.5, -6}}};

Mark read_mark(const SvgElement& mark) {
  if (mark.is("event")) {
    return {mark.is("open") ? "opened" : "closed", centre_of(mark)};
  }
  const Piece corners = testing::read_points(mark.attribute("d"));
  const char* const limit = corners.size() == 4                     ? "capacity"
                            : corners[0].second < corners[1].second ? "limit_max"
                                                                    : "limit_min";
  const auto* const form = std::find_if(std::begin(kForms), std::end(kForms), [&](const MarkForm& one) {
    return mark.is(one.looks) && (!mark.is("limit") || std::string(one.kind) == limit);
  });
  if (form == std::end(kForms)) {
    throw std::runtime_error("a mark of no known form: " + mark.attribute("class"));
  }
  return {form->kind, {corners[0].first - form->corner.first, corners[0].second - form->corner.second}};
}

/// The picture of a case with its axes.
class Picture {
 public:
  explicit Picture(const json& one)
      : one_(one),
        document_(document_of(one, "document")),
        request_(document_of(one, "request")),
        text_(svg_of(document_, plot_request())),
        svg_(text_) {
    const std::vector<Piece> undeformed = pieces("undeformed");
    if (!undeformed.empty()) {
      read_structure_axes(undeformed);
    } else if (one_.at("figure") != "sections") {
      std::tie(x_, y_) = testing::read_axes(svg_);
    }
  }

  [[nodiscard]] const SvgReader& svg() const { return svg_; }
  [[nodiscard]] const json& document() const { return document_; }
  [[nodiscard]] const json& request() const { return request_; }
  [[nodiscard]] double x(double value) const { return x_.pixel(value, one_.at("choices").contains("log")); }
  [[nodiscard]] double y(double value) const { return y_.pixel(value); }
  [[nodiscard]] Place place(const json& point) const { return {x(point.at(0)), y(point.at(1))}; }

  /// Returns the elements with a look that show data: those of a legend, a mirror image or a note are left
  /// out.
  [[nodiscard]] std::vector<SvgElement> with(const std::string& looks) const {
    std::vector<SvgElement> found = svg_.with(looks);
    std::erase_if(found, [](const SvgElement& element) {
      return is_in(element, "legend") || is_in(element, "mirror-image") || is_in(element, "failure-note");
    });
    return found;
  }
  static bool is_in(const SvgElement& element, const std::string& looks) {
    return std::any_of(element.of.begin(), element.of.end(), [&](const std::string& around) {
      return (" " + around + " ").find(" " + looks + " ") != std::string::npos;
    });
  }

  /// Pieces of the lines of a name, in pixels.
  [[nodiscard]] std::vector<Piece> pieces(const std::string& name) const {
    const std::string kind = name.substr(0, name.find(' '));
    const std::string second = name.find(' ') == std::string::npos ? "" : name.substr(name.find(' ') + 1);
    if (kind == "series") {
      return lines("series-line", [&](const SvgElement& line) { return is_in(line, "series-" + second); });
    }
    if (kind == "branch") {
      return lines("branch", [&](const SvgElement& line) { return line.is(second); });
    }
    if (kind == "member") {
      return lines("member", [](const SvgElement& line) { return !line.is("slack"); });
    }
    if (kind == "slack" || kind == "mode" || kind == "undeformed" || kind == "contact") {
      return lines(kind, [](const SvgElement&) { return true; });
    }
    if (kind == "stable" || kind == "unstable" || kind == "untold" || kind == "ratio") {
      return lines(kind == "ratio" ? "stable" : kind,
                   [](const SvgElement& line) { return line.is("path") && !line.is("branch"); });
    }
    throw std::runtime_error("no line is called " + name);
  }

  [[nodiscard]] std::vector<Mark> marks() const {
    std::vector<Mark> all;
    for (const SvgElement& mark : with("mark")) {
      if (!mark.is("failed")) {
        all.push_back(read_mark(mark));
      }
    }
    return all;
  }

  [[nodiscard]] std::vector<std::string> texts(const std::string& within) const {
    std::vector<std::string> all;
    for (const SvgElement& one : svg_.elements()) {
      if (one.name == "text" && (within.empty() || is_in(one, within))) {
        all.push_back(plain_spaces(one.text));
      }
    }
    return all;
  }

 private:
  [[nodiscard]] PlotRequest plot_request() const {
    PlotRequest plot;
    plot.kind = value_of(kPlotKinds, one_.at("figure").get<std::string>());
    if (!plot.kind) {
      throw std::runtime_error("no kind of figure is called " + one_.at("figure").dump());
    }
    plot.solved_request = request_.is_null() ? nullptr : &request_;
    for (const auto& [name, value] : one_.at("choices").items()) {
      take_choice(name, value, plot);
    }
    return plot;
  }

  static void take_choice(const std::string& name, const json& value, PlotRequest& plot) {
    const std::map<std::string, std::optional<std::string>*> texts = {{"monitor", &plot.monitor},
                                                                      {"law", &plot.law},
                                                                      {"output", &plot.output},
                                                                      {"x", &plot.x},
                                                                      {"by", &plot.by}};
    const std::map<std::string, std::optional<std::size_t>*> counts = {
        {"state", &plot.state}, {"mode", &plot.mode}, {"branch", &plot.branch}};
    if (const auto text = texts.find(name); text != texts.end()) {
      *text->second = value.get<std::string>();
    } else if (const auto count = counts.find(name); count != counts.end()) {
      *count->second = value.get<std::size_t>();
    } else if (name == "points") {
      plot.points = value;
    } else if (name == "over_arc_length") {
      plot.over_arc_length = value;
    } else if (name == "magnify") {
      plot.magnify = value.get<double>();
    } else if (name != "log") {  // this library chooses the scale of an axis itself
      throw std::runtime_error("no figure has the choice " + name);
    }
  }

  /// Axes by the box of the undeformed members, which is that of the model's nodes.
  void read_structure_axes(const std::vector<Piece>& undeformed) {
    constexpr double kMost = std::numeric_limits<double>::infinity();
    x_ = {kMost, kMost, -kMost, -kMost};
    y_ = {kMost, -kMost, -kMost, kMost};
    for (const json& node : request_.at("model").at("nodes")) {
      x_.first = std::min(x_.first, node.at("x").get<double>());
      x_.last = std::max(x_.last, node.at("x").get<double>());
      y_.first = std::min(y_.first, node.at("y").get<double>());
      y_.last = std::max(y_.last, node.at("y").get<double>());
    }
    for (const Piece& piece : undeformed) {
      for (const auto& [px, py] : piece) {
        x_.first_pixel = std::min(x_.first_pixel, px);
        x_.last_pixel = std::max(x_.last_pixel, px);
        y_.first_pixel = std::max(y_.first_pixel, py);
        y_.last_pixel = std::min(y_.last_pixel, py);
      }
    }
  }

  template <class Filter>
  [[nodiscard]] std::vector<Piece> lines(const std::string& looks, const Filter& wanted) const {
    std::vector<Piece> all;
    for (const SvgElement& line : with(looks)) {
      if (line.name == "path" && wanted(line)) {
        const std::vector<Piece> own = pieces_of(line);
        all.insert(all.end(), own.begin(), own.end());
      }
    }
    return all;
  }

  const json& one_;
  json document_;
  json request_;
  std::string text_;
  SvgReader svg_;
  ReadAxis x_;
  ReadAxis y_;
};

/// Pairs each wanted thing with one of the drawn ones; both lists have the same length.
template <class T, class Off>
void need_same(const std::vector<T>& wanted, std::vector<T> drawn, const Off& off, double most) {
  need(drawn.size() == wanted.size(),
       std::to_string(drawn.size()) + " are drawn, not " + std::to_string(wanted.size()));
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto nearest = std::min_element(drawn.begin(), drawn.end(), [&](const T& a, const T& b) {
      return off(wanted[i], a) < off(wanted[i], b);
    });
    const double distance = off(wanted[i], *nearest);
    need(distance <= most, "number " + std::to_string(i) + " is off by " + std::to_string(distance) + " px");
    drawn.erase(nearest);
  }
}

void need_mark(const Picture& picture, const json& fact) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [kind, at] : picture.marks()) {
    if (kind == fact.at("kind")) {
      const double across = std::abs(at.first - picture.x(fact.at("x")));
      const double up = fact.at("y").is_null() ? 0 : std::abs(at.second - picture.y(fact.at("y")));
      least = std::min(least, std::max(across, up));
    }
  }
  need(least <= tolerance("mark"), "the nearest mark is off by " + std::to_string(least) + " px");
}

void need_mark_counts(const Picture& picture, const json& fact) {
  json counts = json::object();
  for (const Mark& mark : picture.marks()) {
    counts[mark.kind] = counts.value(mark.kind, 0) + 1;
  }
  need(counts == fact.at("counts"), "the marks are " + counts.dump());
}

void need_line_through(const Picture& picture, const json& fact) {
  const std::vector<Piece> pieces = picture.pieces(fact.at("line"));
  for (const json& point : fact.at("points")) {
    double least = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces) {
      least = std::min(least, distance_to(piece, picture.place(point)));
    }
    need(least <= tolerance("line"), point.dump() + " is " + std::to_string(least) + " px off the line");
  }
}

void need_pieces(const Picture& picture, const json& fact) {
  using Ends = std::pair<Place, Place>;
  std::vector<Ends> drawn;
  for (const Piece& piece : picture.pieces(fact.at("line"))) {
    drawn.emplace_back(piece.front(), piece.back());
  }
  std::vector<Ends> wanted;
  for (const json& ends : fact.at("ends")) {
    wanted.emplace_back(picture.place(ends.at(0)), picture.place(ends.at(1)));
  }
  need_same(
      wanted, drawn,
      [](const Ends& a, const Ends& b) {
        return std::max(apart(a.first, b.first), apart(a.second, b.second));
      },
      tolerance("mark"));
}

/// Points of the lines, and the middles between them, are on a circle in values of the axes.
void need_circle(const Picture& picture, const json& fact) {
  const double radius = fact.at("radius");
  const Place middle = picture.place(fact.at("centre"));
  const double across = (picture.x(fact.at("centre").at(0).get<double>() + radius) - middle.first) / radius;
  const double up = (picture.y(fact.at("centre").at(1).get<double>() + radius) - middle.second) / radius;
  double most = 0;
  std::size_t count = 0;
  const auto take = [&](double px, double py) {
    const double distance = std::hypot((px - middle.first) / across, (py - middle.second) / up);
    most = std::max(most, std::abs(distance - radius));
    ++count;
  };
  for (const json& name : fact.at("lines")) {
    for (const Piece& piece : picture.pieces(name)) {
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const Place& before = piece[i == 0 ? 0 : i - 1];
        take(piece[i].first, piece[i].second);
        take(0.5 * (before.first + piece[i].first), 0.5 * (before.second + piece[i].second));
      }
    }
  }
  need(count > 8, "no line is drawn");
  need(most <= fact.at("within"), "off the circle by " + std::to_string(most));
}

/// Circles at the same place are one.
void need_dots(const Picture& picture, const json& fact) {
  std::set<Place> drawn;
  for (const SvgElement& dot : picture.with(fact.at("looks"))) {
    if (dot.name == "circle") {
      drawn.insert(centre_of(dot));
    }
  }
  std::vector<Place> wanted;
  for (const json& point : fact.at("at")) {
    wanted.push_back(picture.place(point));
  }
  need_same(wanted, std::vector<Place>(drawn.begin(), drawn.end()), apart, tolerance("mark"));
}

/// Crosses stand at whole pixels.
void need_failed(const Picture& picture, const json& fact) {
  std::vector<double> drawn;
  for (const SvgElement& crosses : picture.with("failed")) {
    const Piece corners = testing::read_points(crosses.attribute("d"));
    for (std::size_t i = 0; i + 3 < corners.size(); i += 4) {
      drawn.push_back(0.5 * (corners[i].first + corners[i + 1].first));
    }
  }
  std::vector<double> wanted;
  for (const json& value : fact.at("x")) {
    wanted.push_back(picture.x(value));
  }
  need_same(
      wanted, drawn, [](double a, double b) { return std::abs(a - b); }, 0.51);
}

/// A panel of a section diagram: its axis, its dots, and the numbers that are written.
struct Panel {
  double left = 0, right = 0, zero = 0;
  std::vector<Place> dots;
  std::vector<double> values;
};

Panel read_panel(const Picture& picture, const std::string& quantity) {
  const auto in_panel = [&](const SvgElement& one) { return Picture::is_in(one, "section-" + quantity); };
  Panel panel;
  for (const SvgElement& axis : picture.with("axis")) {
    if (in_panel(axis) && axis.attribute("y1") == axis.attribute("y2")) {
      panel.left = axis.number("x1");
      panel.right = axis.number("x2");
      panel.zero = axis.number("y1");
    }
  }
  for (const SvgElement& dot : picture.with("section-dot")) {
    if (in_panel(dot)) {
      panel.dots.push_back(centre_of(dot));
    }
  }
  for (const SvgElement& text : picture.with("section-value")) {
    if (in_panel(text)) {
      panel.values.push_back(testing::written_number(text.text));
    }
  }
  return panel;
}

/// Length of the members before one, and of all.
std::pair<double, double> lengths_of(const Picture& picture, const std::string& member) {
  double before = 0;
  double total = 0;
  for (const json& one : picture.request().at("model").at("members")) {
    const json& state =
        picture.document().at("states").at(0).at("members").at(one.at("id").get<std::string>());
    before = one.at("id") == member ? total : before;
    total += state.at("s").back().get<double>();
  }
  return {before, total};
}

/// The marked values of a quantity: place along the members one after another, number, and height in
/// proportion.
void need_extremes(const Picture& picture, const json& fact) {
  const Panel panel = read_panel(picture, fact.at("quantity"));
  const json& wanted = fact.at("at");
  need(panel.dots.size() == wanted.size() && panel.values.size() == wanted.size(),
       std::to_string(panel.dots.size()) + " extremes are marked");
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto [before, total] = lengths_of(picture, wanted[i].at("member"));
    const double value = wanted[i].at("value");
    const double x =
        panel.left + (before + wanted[i].at("s").get<double>()) / total * (panel.right - panel.left);
    need(std::abs(panel.dots[i].first - x) <= tolerance("mark"),
         wanted[i].dump() + " stands at " + text_of(panel.dots[i]) + ", not at " + std::to_string(x));
    need(std::abs(panel.values[i] - value) <= 5e-4 * std::abs(value),
         std::to_string(panel.values[i]) + " is written, not " + std::to_string(value));
    const double height = (panel.zero - panel.dots[0].second) * value / wanted[0].at("value").get<double>();
    need(std::abs(panel.zero - panel.dots[i].second - height) <= 2 * tolerance("mark"),
         wanted[i].dump() + " is not " + std::to_string(height) + " px high");
  }
}

void need_all(const json& wanted, const std::vector<std::string>& found) {
  for (const json& text : wanted) {
    need(std::find(found.begin(), found.end(), text.get<std::string>()) != found.end(),
         text.dump() + " is not among " + json(found).dump());
  }
}

/// How many elements of a look are drawn, the legend among them.
void need_count(const Picture& picture, const json& fact) {
  const std::size_t count = picture.svg().with(fact.at("looks")).size();
  need(count == fact.at("count"), std::to_string(count) + " are drawn");
}

/// What the description says of the breaks of curves.
void need_breaks(const Picture& picture, const json& fact) {
  const auto& all = picture.svg().elements();
  const auto told =
      std::find_if(all.begin(), all.end(), [](const SvgElement& one) { return one.name == "desc"; });
  const std::size_t count = fact.at("count");
  const std::string words = count == 1 ? " One break:" : " " + std::to_string(count) + " breaks:";
  need(told != all.end() && told->text.find(words) != std::string::npos, told->text);
}

using Need = std::function<void(const Picture&, const json&)>;

const std::map<std::string, Need>& needs() {
  static const std::map<std::string, Need> all = {
      {"mark", need_mark},
      {"marks", need_mark_counts},
      {"through", need_line_through},
      {"pieces", need_pieces},
      {"circle", need_circle},
      {"dots", need_dots},
      {"failed", need_failed},
      {"extremes", need_extremes},
      {"count", need_count},
      {"breaks", need_breaks},
      {"texts",
       [](const Picture& picture, const json& fact) { need_all(fact.at("texts"), picture.texts("")); }},
      {"legend", [](const Picture& picture, const json& fact) {
         need_all(fact.at("entries"), picture.texts("legend"));
       }}};
  return all;
}

void check(const Picture& picture, const json& fact) {
  const std::string library = fact.value("not_yet", "");
  ASSERT_THAT(library, ::testing::AnyOf("", "page", "plot"));
  const auto need_it = needs().find(fact.at("fact"));
  ASSERT_NE(need_it, needs().end()) << "no reader of the fact " << fact.dump();
  try {
    need_it->second(picture, fact);
  } catch (const Unmet& unmet) {
    EXPECT_EQ(library, "plot") << fact.dump() << "\n" << unmet.what();
    return;
  }
  EXPECT_NE(library, "plot") << "is met now: " << fact.dump();
}

class SharedFigures : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SharedFigures, HaveTheirFacts) {
  const json& one = cases().at("cases").at(GetParam());
  const Picture picture(one);
  ASSERT_FALSE(one.at("facts").empty());
  for (const json& fact : one.at("facts")) {
    check(picture, fact);
  }
}

std::string name_of_case(std::size_t number) { return cases().at("cases").at(number).at("name"); }

INSTANTIATE_TEST_SUITE_P(Cases, SharedFigures, ::testing::Range<std::size_t>(0, cases().at("cases").size()),
                         [](const auto& one) { return name_of_case(one.param); });

TEST(SharedFiguresList, HasAsManyCasesAsItSays) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < cases().at("cases").size(); ++i) {
    names.insert(name_of_case(i));
  }
  EXPECT_GE(names.size(), cases().at("least_cases").get<std::size_t>());
  EXPECT_EQ(names.size(), cases().at("cases").size()) << "each has a name of its own";
}

}  // namespace
}  // namespace snapthrough::api
