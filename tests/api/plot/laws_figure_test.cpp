/// The figure of all laws of a model: by depth, beyond peaks, on one side, and which of them it shows. Curves
/// are those of closed forms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "api/plot/plot.h"
#include "api/plot/plot_error.h"
#include "tests/api/plot/documents.h"
#include "tests/api/plot/svg_reader.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ReadAxis;
using ::testing::SizeIs;
using testing::SvgElement;
using testing::SvgReader;

constexpr double kPixel = 0.08;  // coordinates are written to a hundredth, lines thinned by a twentieth

std::string text_of(const json& document, PlotRequest plot = {}) {
  plot.kind = PlotKind::laws;
  return svg_of(document, plot);
}

std::string text_of(const json& document, const std::string& id) {
  PlotRequest plot;
  plot.law = id;
  return text_of(document, plot);
}

PlotError error_of(const json& document, const std::optional<std::string>& id = std::nullopt) {
  PlotRequest plot;
  plot.law = id;
  try {
    (void)text_of(document, plot);
  } catch (const PlotError& error) {
    return error;
  }
  return {"", "no error"};
}

bool is_in(const SvgElement& element, const std::string& looks) {
  return std::any_of(element.of.begin(), element.of.end(), [&](const std::string& around) {
    return (" " + around + " ").find(" " + looks + " ") != std::string::npos;
  });
}

/// A diagram as a reader sees it.
class Diagram {
 public:
  explicit Diagram(const std::string& text, std::size_t number = 0) : svg_(text) {
    for (const SvgElement& one : svg_.elements()) {
      if (is_in(one, "panel-" + std::to_string(number))) {
        elements_.push_back(one);
      }
    }
    std::tie(x, y) = testing::read_axes(*this);
  }

  [[nodiscard]] std::vector<SvgElement> with(const std::string& looks) const {
    std::vector<SvgElement> found;
    std::copy_if(elements_.begin(), elements_.end(), std::back_inserter(found),
                 [&](const SvgElement& one) { return one.is(looks); });
    return found;
  }
  [[nodiscard]] std::vector<std::string> texts(const std::string& looks) const {
    std::vector<std::string> all;
    for (const SvgElement& one : with(looks)) {
      all.push_back(one.text);
    }
    return all;
  }
  /// Points of the lines in values of the axes, without those of the key.
  [[nodiscard]] std::vector<std::vector<std::pair<double, double>>> lines(bool flat = false) const {
    std::vector<std::vector<std::pair<double, double>>> all;
    for (const SvgElement& line : with("law-line")) {
      if (is_in(line, "legend") || line.is("law-flat") != flat) {
        continue;
      }
      auto& points = all.emplace_back();
      for (const auto& [px, py] : testing::read_points(line.attribute("d"))) {
        points.emplace_back(value(x, px), value(y, py));
      }
    }
    return all;
  }
  [[nodiscard]] std::vector<std::pair<double, double>> marks(const std::string& looks) const {
    std::vector<std::pair<double, double>> all;
    for (const SvgElement& one : with(looks)) {
      all.emplace_back(value(x, one.number("cx")), value(y, one.number("cy")));
    }
    return all;
  }
  [[nodiscard]] double pixel_x() const { return std::abs(value(x, 1) - value(x, 0)); }
  [[nodiscard]] double pixel_y() const { return std::abs(value(y, 1) - value(y, 0)); }

  static double value(const ReadAxis& axis, double pixel) {
    return axis.first +
           (pixel - axis.first_pixel) / (axis.last_pixel - axis.first_pixel) * (axis.last - axis.first);
  }

 private:
  SvgReader svg_;
  std::vector<SvgElement> elements_;

 public:
  ReadAxis x;
  ReadAxis y;
};

/// A pile from y = 0 to y = -10 with foundations.
json pile_with(json foundations) {
  return {{"units", {{"length", "m"}, {"force", "kN"}}},
          {"nodes", {{{"id", "head"}, {"x", 0}, {"y", 0}}, {{"id", "toe"}, {"x", 0}, {"y", -10}}}},
          {"members", {{{"id", "pile"}, {"start", "head"}, {"end", "toe"}, {"section", "tube"}}}},
          {"foundations", std::move(foundations)}};
}

json along(double from, double to) { return {{"along", {{0, from}, {1, to}}}}; }

/// Expects that points are those of p = P tanh(k w / P), where steepness needs room to the pixel across.
void expect_tanh(const Diagram& diagram, const std::vector<std::pair<double, double>>& line, double k,
                 double P) {
  ASSERT_GE(line.size(), 8U);
  for (const auto& [w, p] : line) {
    const double off = kPixel * (diagram.pixel_y() + k * diagram.pixel_x());
    EXPECT_NEAR(p, P * std::tanh(k * w / P), off) << w;
  }
}

TEST(LawsFigure, NumbersLinearInDepthGiveFiveDepthsFromTopToBottom) {
  const Diagram diagram(text_of(pile_with(
      {{{"id", "clay"},
        {"member", "pile"},
        {"law", {{"type", "tanh"}, {"stiffness", along(800, 2400)}, {"capacity", along(10, 50)}}}}})));
  EXPECT_THAT(diagram.texts("law-title"), ElementsAre("Across pile clay"));
  EXPECT_THAT(diagram.texts("axis-label"), ElementsAre("displacement w (m)", "reaction p (kN/m)"));
  EXPECT_THAT(diagram.texts("legend-text"),
              ElementsAre("height y (m)", "0", "\u22122.5", "\u22125", "\u22127.5", "\u221210"));
  EXPECT_THAT(diagram.texts("muted"), Contains("alike in both senses"));
  const auto lines = diagram.lines();
  ASSERT_THAT(lines, SizeIs(5));
  for (std::size_t i = 0; i < 5; ++i) {
    const double share = 0.25 * static_cast<double>(i);
    expect_tanh(diagram, lines[i], 800 + 1600 * share, 10 + 40 * share);
  }
  EXPECT_THAT(diagram.lines(true), IsEmpty()) << "a tanh is nowhere constant";
  const std::vector<SvgElement> laws = diagram.with("law");
  for (const std::size_t i : {0U, 2U, 4U}) {
    EXPECT_TRUE(laws.at(i).is("depth-" + std::to_string(2 * i))) << "colours go from top to bottom";
  }
}

/// Tables whose factors fall linearly from 1 at one place to 0 at the other, as soil gives them.
TEST(LawsFigure, FoundationsThatOverlapAreAddedAtEachDepth) {
  const auto table = [](const char* id, double w, double p, const json& factor) {
    return json{
        {"id", id},
        {"member", "pile"},
        {"law", {{"type", "table"}, {"points", {{w, p}}}, {"interpolation", "linear"}, {"factor", factor}}}};
  };
  const Diagram diagram(
      text_of(pile_with({table("upper", 0.01, 20, along(1, 0)), table("lower", 0.02, 100, along(0, 1))})));
  const auto lines = diagram.lines();
  const auto flat = diagram.lines(true);
  ASSERT_THAT(lines, SizeIs(5));
  ASSERT_THAT(flat, SizeIs(5));
  EXPECT_THAT(diagram.texts("law-title"), ElementsAre("Across pile upper, lower"));
  for (std::size_t i = 0; i < 5; ++i) {
    const double share = 0.25 * static_cast<double>(i);
    EXPECT_NEAR(flat[i].front().second, 20 * (1 - share) + 100 * share, kPixel * diagram.pixel_y());
    EXPECT_NEAR(flat[i].front().first, i == 0 ? 0.01 : 0.02, kPixel * diagram.pixel_x())
        << "constant from the last point of the last table";
    EXPECT_NEAR(flat[i].back().first, 1.2 * 0.02, kPixel * diagram.pixel_x());
  }
  ASSERT_THAT(lines[2], SizeIs(3)) << "half of both: a bend at each table's end";
  EXPECT_NEAR(lines[2][1].first, 0.01, kPixel * diagram.pixel_x());
  EXPECT_NEAR(lines[2][1].second, 0.5 * 20 + 0.5 * 50, 2 * kPixel * diagram.pixel_y());
}

TEST(LawsFigure, AJumpHasALawAboveAndOneBelow) {
  const auto layer = [](const char* id, double from, double to, const json& capacity) {
    return json{{"id", id},
                {"member", "pile"},
                {"range", {from, to}},
                {"law", {{"type", "tanh"}, {"stiffness", 1000}, {"capacity", capacity}}}};
  };
  const json varying = {{"along", {{0.4, 60}, {1, 90}}}};
  const Diagram diagram(text_of(pile_with(
      {layer("fill", 0, 0.2, 5), layer("clay", 0.2, 0.4, along(10, 10)), layer("sand", 0.4, 1, varying)})));
  EXPECT_THAT(diagram.texts("legend-text"),
              ElementsAre("height y (m)", "0 to \u22122", "\u22122 to \u22124", "\u22124 below", "\u221210"));
  const auto lines = diagram.lines();
  ASSERT_THAT(lines, SizeIs(4));
  const double capacities[] = {5, 10, 60, 90};
  for (std::size_t i = 0; i < 4; ++i) {
    expect_tanh(diagram, lines[i], 1000, capacities[i]);
  }
}

TEST(LawsFigure, FallingLawsHaveTheirPeakAndResidualMarked) {
  const json law = {{"type", "table"},
                    {"interpolation", "linear"},
                    {"points", {{0.01, 30}, {0.02, 50}, {0.06, 20}, {0.1, 20}}}};
  const std::string text = text_of(pile_with({{{"id", "ballast"}, {"member", "pile"}, {"law", law}}}));
  const Diagram diagram(text);
  const auto peaks = diagram.marks("law-peak");
  const auto residuals = diagram.marks("law-residual");
  ASSERT_THAT(peaks, SizeIs(1));
  ASSERT_THAT(residuals, SizeIs(1));
  EXPECT_NEAR(peaks[0].first, 0.02, kPixel * diagram.pixel_x());
  EXPECT_NEAR(peaks[0].second, 50, kPixel * diagram.pixel_y());
  EXPECT_NEAR(residuals[0].first, 0.06, kPixel * diagram.pixel_x()) << "the first of the last equal forces";
  EXPECT_NEAR(residuals[0].second, 20, kPixel * diagram.pixel_y());
  EXPECT_THAT(diagram.texts("law-value"), ElementsAre("50", "20"));
  EXPECT_THAT(SvgReader(text).texts(), Contains("residual"));
  EXPECT_THAT(text, HasSubstr("peak 50\u00a0kN/m at 0.02\u00a0m, residual 20\u00a0kN/m at 0.06\u00a0m."));
  // a falling table beside a growing law: p = 50 - 750 (w - 0.02) + 900 w falls at no displacement
  const std::string grows = text_of(pile_with({{{"id", "ballast"}, {"member", "pile"}, {"law", law}},
                                               {{"id", "pad"}, {"member", "pile"}, {"stiffness", 900}}}));
  EXPECT_THAT(Diagram(grows).marks("law-peak"), IsEmpty());
  EXPECT_THAT(SvgReader(grows).texts(), Not(Contains("peak")));
}

/// The sum of P tanh(k w / P) and a table that falls from 40 at w = 0.01 to 0 at w = 0.05, by 1000 per unit
/// of w, has its peak between the table's points, where the slope k / cosh^2(k w / P) of the first law is
/// 1000.
TEST(LawsFigure, APeakBetweenThePointsOfTablesIsFound) {
  const double k = 4000;
  const double P = 60;
  const Diagram diagram(text_of(pile_with(
      {{{"id", "a"}, {"member", "pile"}, {"law", {{"type", "tanh"}, {"stiffness", k}, {"capacity", P}}}},
       {{"id", "b"},
        {"member", "pile"},
        {"law", {{"type", "table"}, {"interpolation", "linear"}, {"points", {{0.01, 40}, {0.05, 0}}}}}}})));
  const double w = P / k * std::acosh(std::sqrt(k / 1000));
  const double p = P * std::tanh(k * w / P) + 40 - 1000 * (w - 0.01);
  const auto peaks = diagram.marks("law-peak");
  ASSERT_THAT(peaks, SizeIs(1));
  EXPECT_NEAR(peaks[0].first, w, kPixel * diagram.pixel_x());
  EXPECT_NEAR(peaks[0].second, p, kPixel * diagram.pixel_y());
  EXPECT_THAT(diagram.marks("law-residual"), IsEmpty()) << "the tanh is nowhere constant";
}

TEST(LawsFigure, OneSidedLawsAreDrawnOnTheirSideOnly) {
  const json law = {
      {"type", "power"}, {"stiffness", 4000}, {"capacity", 30}, {"reference", 0.05}, {"exponent", 0.5}};
  const json model = pile_with(
      {{{"id", "front"}, {"member", "pile"}, {"reaction", "compression_only"}, {"gap", 0.02}, {"law", law}},
       {{"id", "back"}, {"member", "pile"}, {"side", "right"}, {"reaction", "tension_only"}, {"law", law}}});
  const std::string text = text_of(model);
  const Diagram front(text, 0);
  EXPECT_THAT(front.texts("muted"), Contains("left side, compression only; the same everywhere"));
  const auto pushed = front.lines().at(0);
  EXPECT_NEAR(pushed.front().first, -0.25 * (0.02 + 0.06), 1e-4);
  EXPECT_NEAR(pushed[1].first, 0.02, 1e-4) << "zero up to the gap";
  EXPECT_NEAR(pushed[1].second, 0, 0.02);
  EXPECT_NEAR(pushed.back().first, 0.07, 1e-4);
  EXPECT_NEAR(pushed.back().second, 30, 0.02);
  EXPECT_NEAR(front.lines(true).at(0).back().first, 0.02 + 0.06, 1e-4);
  const Diagram back(text, 1);
  EXPECT_THAT(back.texts("muted"), Contains("right side, tension only; the same everywhere"));
  const auto pulled = back.lines().at(0);
  EXPECT_NEAR(pulled.front().first, 0.25 * 0.06, 1e-4);
  for (const auto& [w, p] : pulled) {
    EXPECT_LE(p, 0.02) << w;
    EXPECT_TRUE(w < 1e-4 || p > -0.02) << w;
  }
  EXPECT_NEAR(pulled.back().second, -30, 0.02);
}

TEST(LawsFigure, ManyDepthsAreTakenEvenlyAndCounted) {
  json pairs = json::array();
  for (int i = 0; i <= 40; ++i) {  // close together at the head
    const double fraction = i * i / 1600.0;
    pairs.push_back({fraction, 10 + 90 * fraction * fraction});
  }
  const std::string text = text_of(
      pile_with({{{"id", "clay"},
                  {"member", "pile"},
                  {"law", {{"type", "tanh"}, {"stiffness", 900}, {"capacity", {{"along", pairs}}}}}}}));
  const Diagram diagram(text);
  EXPECT_THAT(diagram.texts("muted"), Contains("9 heights, given at 41; alike in both senses"));
  EXPECT_THAT(diagram.texts("legend-text"),
              ElementsAre("height y (m)", "0", "\u22121.25", "\u22122.5", "\u22123.75", "\u22125",
                          "\u22126.25", "\u22127.5", "\u22128.75", "\u221210"));
  const auto lines = diagram.lines();
  ASSERT_THAT(lines, SizeIs(9));
  const double before = 28 * 28 / 1600.0;  // 0.5 lies between the given 0.49 and 0.525625
  const double after = 29 * 29 / 1600.0;
  const double share = (0.5 - before) / (after - before);
  const auto at = [](double fraction) { return 10 + 90 * fraction * fraction; };
  expect_tanh(diagram, lines[4], 900, at(before) + share * (at(after) - at(before)));
}

/// API sand is p = P tanh(k X w / P) at the depth X, and soft clay has P = 3 Su D at the surface, reached at
/// 8 * 2.5 eps50 D.
TEST(LawsFigure, APileInLayersHasTheLawsOfItsSoilByDepth) {
  const json request = testing::example_request("pile_in_layers");
  const Diagram diagram(text_of(request));
  EXPECT_THAT(diagram.texts("law-title"), ElementsAre("Across shaft soil"));
  EXPECT_THAT(diagram.texts("legend-text"),
              ElementsAre("depth (m)", "0", "2.25", "4.5", "6.75", "9", "11.25", "13.5", "15.75", "18"));
  const auto lines = diagram.lines();
  ASSERT_THAT(lines, SizeIs(9));
  const auto flat = diagram.lines(true);
  ASSERT_THAT(flat, SizeIs(3)) << "the clay's";
  EXPECT_NEAR(flat[0].front().first, 8 * 2.5 * 0.015, kPixel * diagram.pixel_x());
  EXPECT_NEAR(flat[0].front().second, 3 * 15, 0.001 * 45 + kPixel * diagram.pixel_y());
  for (std::size_t i = 3; i < 9; ++i) {
    const double X = 2.25 * static_cast<double>(i);
    expect_tanh(diagram, lines[i], 15000 * X, lines[i].back().second);
  }
}

/// What a model of several kinds of laws has for each.
json model_of_all() {
  const json law = {{"type", "tanh"}, {"stiffness", 900}, {"capacity", 20}};
  json model = pile_with({{{"id", "across"}, {"member", "pile"}, {"law", law}},
                          {{"id", "along"}, {"member", "pile"}, {"component", "tangent"}, {"law", law}},
                          {{"id", "turn"}, {"member", "pile"}, {"component", "rotation"}, {"law", law}},
                          {{"id", "bed"}, {"member", "pile"}, {"component", "tangent"}, {"stiffness", 7}}});
  model["springs"] = {{{"id", "q-z"},
                       {"at", {{"node", "toe"}}},
                       {"direction", {0, -1}},
                       {"reaction", "compression_only"},
                       {"law", law}},
                      {{"id", "soft"}, {"at", {{"node", "toe"}}}, {"direction", {1, 0}}, {"stiffness", 5}},
                      {{"id", "base"}, {"at", {{"node", "toe"}}}, {"direction", "rotation"}, {"law", law}}};
  model["members"][0]["release"] = {{"start", {{"rotation", {{"law", law}}}}}, {"end", {{"rotation", 5}}}};
  return model;
}

TEST(LawsFigure, EachKindOfLawHasADiagramWithItsAxes) {
  const std::string text = text_of(model_of_all());
  const std::vector<std::vector<std::string>> wanted = {
      {"Across pile across", "displacement w (m)", "reaction p (kN/m)"},
      {"Along pile along, bed", "displacement w (m)", "reaction p (kN/m)"},
      {"Against rotation of pile turn", "rotation w (rad)", "moment/length p (kN)"},
      {"Springs q-z", "displacement w (m)", "reaction p (kN)"},
      {"Springs against rotation base", "rotation w (rad)", "moment p (kN\u202fm)"},
      {"Joints pile start", "rotation w (rad)", "moment p (kN\u202fm)"}};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Diagram diagram(text, i);
    EXPECT_THAT(diagram.texts("law-title"), ElementsAre(wanted[i][0]));
    EXPECT_THAT(diagram.texts("axis-label"), ElementsAre(wanted[i][1], wanted[i][2]));
  }
  EXPECT_THAT(SvgReader(text).with("law-panel"), SizeIs(wanted.size()));
  const auto low = [&](const char* id) {
    return SvgReader(text_of(model_of_all(), id)).with("law-panel").size();
  };
  EXPECT_EQ(low("turn"), 1U);
  EXPECT_EQ(low("q-z"), 1U);
  EXPECT_EQ(low("pile"), 1U) << "the joint of the member";
}

TEST(LawsFigure, AFoundationInSoilIsChosenWithAllThatItGives) {
  const json request = testing::example_request("monopile");
  EXPECT_THAT(SvgReader(text_of(request, "soil")).with("law-panel"), SizeIs(4));
  const Diagram base(text_of(request, "soil base shear"));
  EXPECT_THAT(base.texts("law-title"), ElementsAre("Springs soil base shear"));
  EXPECT_THAT(error_of(request, "so").rule(), HasSubstr("has no law of \"so\"; those with a law are: soil"));
}

TEST(LawsFigure, EqualLawsOfJoinedMembersAndOfSpringsAreOne) {
  json model = pile_with(json::array());
  model["nodes"].push_back({{"id", "knee"}, {"x", 8}, {"y", -10}});
  model["members"].push_back({{"id", "arm"}, {"start", "knee"}, {"end", "toe"}, {"section", "tube"}});
  const json law = {{"type", "hyperbolic"}, {"stiffness", 900}, {"capacity", 20}};
  for (const char* member : {"pile", "arm"}) {
    model["foundations"].push_back({{"id", std::string("on ") + member}, {"member", member}, {"law", law}});
  }
  for (const char* id : {"s1", "s2", "s3"}) {
    model["springs"].push_back({{"id", id}, {"at", {{"node", "toe"}}}, {"direction", {1, 0}}, {"law", law}});
  }
  model["springs"][1]["law"]["capacity"] = 30;
  const std::string text = text_of(model);
  const Diagram ground(text, 0);
  EXPECT_THAT(ground.texts("law-title"), ElementsAre("Across pile \u2026 arm on pile, on arm"));
  EXPECT_THAT(ground.lines(), SizeIs(1));
  EXPECT_THAT(Diagram(text, 1).texts("legend-text"), ElementsAre("s1 + 1", "s2"));
  model["foundations"][1]["law"]["capacity"] = along(20, 60);  // from the knee, which the chain ends at
  const Diagram varied(text_of(model), 0);
  EXPECT_THAT(varied.texts("legend-text"), ElementsAre("distance s (m)", "0 to 10", "10 beyond", "14", "18"));
}

TEST(LawsFigure, DiagramsThatFindNoRoomAreCounted) {
  PlotRequest plot;
  plot.height = 300;
  const SvgReader svg(text_of(model_of_all(), plot));
  EXPECT_THAT(svg.with("law-panel"), SizeIs(2));
  EXPECT_THAT(svg.texts(), Contains("Laws of supports: 2 of 6 diagrams"));
  EXPECT_EQ(svg.elements()[0].number("height"), 300);
  const SvgReader whole(text_of(model_of_all()));
  EXPECT_THAT(whole.texts(), Contains("Laws of supports"));
  EXPECT_GT(whole.elements()[0].number("height"), 480) << "three rows need more than the default";
  for (const SvgElement& one : whole.elements()) {
    if (one.name == "text" && is_in(one, "panel-5")) {
      EXPECT_LE(one.number("y") + 600, whole.elements()[0].number("height"));
    }
  }
}

TEST(LawsFigure, MistakesAreNamedByTheirPlaces) {
  json model = model_of_all();
  model["foundations"][0]["member"] = "rope";
  EXPECT_EQ(error_of(model).pointer(), "/foundations/0/member");
  model = model_of_all();
  model["foundations"][1]["law"]["capacity"] = -1;
  EXPECT_EQ(error_of({{"model", model}}).pointer(), "/model/foundations/1/law/capacity");
  model = model_of_all();
  model["foundations"][2]["range"] = {0.5, 0.2};
  EXPECT_EQ(error_of(model).pointer(), "/foundations/2/range");
  const json linear = pile_with({{{"id", "bed"}, {"member", "pile"}, {"stiffness", 7}}});
  EXPECT_THAT(error_of(linear).rule(), HasSubstr("no spring, foundation or joint of the model has a law"));
  EXPECT_THAT(error_of(json::array()).rule(), HasSubstr("no model with nodes"));
}

/// Relative luminance and contrast as WCAG 2.1 defines them.
double luminance(const std::string& colour) {
  double sum = 0;
  const double weights[] = {0.2126, 0.7152, 0.0722};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    sum += weights[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

TEST(LawsFigure, ColoursByDepthAreAScaleOfLightnessThatStandsOutFromThePaper) {
  for (const bool dark : {false, true}) {
    PlotRequest plot;
    plot.dark = dark;
    const std::string text = text_of(model_of_all(), plot);
    const double paper = dark ? luminance("#161b22") : 1;
    double last = paper;
    for (int i = 0; i < 9; ++i) {
      const std::string rule = ".depth-" + std::to_string(i) + " { color: ";
      const std::size_t at = text.find(rule);
      ASSERT_NE(at, std::string::npos) << rule;
      const double here = luminance(text.substr(at + rule.size(), 7));
      const auto [low, high] = std::minmax(here, paper);
      EXPECT_GE((high + 0.05) / (low + 0.05), 3) << "least contrast of graphics, " << rule;
      const auto [darker, lighter] = std::minmax(here, last);
      EXPECT_EQ(here > last, dark) << rule;
      EXPECT_GE((lighter + 0.05) / (darker + 0.05), 1.15) << "steps that can be told apart, " << rule;
      last = here;
    }
  }
}

}  // namespace
}  // namespace snapthrough::api
