/// Figures of laws, of frequencies and of stiffness ratios: what they show stands where a reader of the axes
/// looks for it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "api/plot/plot.h"
#include "api/plot/plot_error.h"
#include "api/plot/plot_request.h"
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

constexpr double kPixel = 0.05;  // coordinates are written to a hundredth, ticks at both ends of an axis

/// A figure with its axes.
struct Chart {
  Chart(const json& document, PlotKind kind, PlotRequest request = {})
      : svg(text_of(document, kind, request)) {
    std::tie(x, y) = testing::read_axes(svg);
  }
  static std::string text_of(const json& document, PlotKind kind, PlotRequest request) {
    request.kind = kind;
    return svg_of(document, request);
  }

  /// Points, in values of the axes, of the lines with this look outside of the legend.
  [[nodiscard]] std::vector<std::vector<std::pair<double, double>>> lines(const std::string& looks) const {
    std::vector<std::vector<std::pair<double, double>>> all;
    for (const SvgElement& line : svg.with(looks)) {
      if (line.name != "path") {
        continue;
      }
      auto& points = all.emplace_back();
      for (const auto& [px, py] : testing::read_points(line.attribute("d"))) {
        points.emplace_back(value(x, px), value(y, py));
      }
    }
    return all;
  }
  /// Whether a circle with this look stands at a place given in values of the axes.
  [[nodiscard]] bool has_dot(const std::string& looks, double at_x, double at_y) const {
    for (const SvgElement& dot : svg.with(looks)) {
      if (std::abs(dot.number("cx") - x.pixel(at_x)) < kPixel &&
          std::abs(dot.number("cy") - y.pixel(at_y)) < kPixel) {
        return true;
      }
    }
    return false;
  }
  /// Places of the marks with this look in pixels: the middle between opposite corners of diamonds, squares
  /// and the hourglass.
  [[nodiscard]] std::vector<std::pair<double, double>> marks(const std::string& looks) const {
    std::vector<std::pair<double, double>> all;
    for (const SvgElement& mark : svg.with(looks)) {
      if (mark.of.empty() || mark.of.back() != "marks") {
        continue;
      }
      const auto corners = testing::read_points(mark.attribute("d"));
      if (looks == "limit") {  // a triangle, whose first corner stands 6.5 above
        all.emplace_back(corners[0].first, corners[0].second + 6.5);
      } else {
        const auto& other = corners[looks == "flutter" ? 3 : 2];
        all.emplace_back(0.5 * (corners[0].first + other.first), 0.5 * (corners[0].second + other.second));
      }
    }
    return all;
  }
  void expect_mark(const std::string& looks, double at_x, double at_y) const {
    const auto all = marks(looks);
    ASSERT_THAT(all, SizeIs(1)) << looks;
    EXPECT_NEAR(all[0].first, x.pixel(at_x), kPixel) << looks;
    EXPECT_NEAR(all[0].second, y.pixel(at_y), kPixel) << looks;
  }

  static double value(const ReadAxis& axis, double pixel) {
    return axis.first +
           (pixel - axis.first_pixel) / (axis.last_pixel - axis.first_pixel) * (axis.last - axis.first);
  }

  SvgReader svg;
  ReadAxis x;
  ReadAxis y;
};

PlotError error_of(const json& document, PlotKind kind, PlotRequest request = {}) {
  request.kind = kind;
  try {
    (void)svg_of(document, request);
  } catch (const PlotError& error) {
    return error;
  }
  return {"", "no error"};
}

/// A model with one foundation of a law.
json with_law(const json& law) {
  return {{"nodes", json::array()},
          {"units", {{"length", "m"}, {"force", "kN"}}},
          {"foundations", {{{"id", "ground"}, {"member", "beam"}, {"law", law}}}}};
}

using Formula = std::function<double(double)>;

/// Expects an odd curve of a formula up to a displacement on both sides, within a pixel's accuracy.
void expect_curve(const json& law, const Formula& formula, double reach) {
  SCOPED_TRACE(law.dump());
  const Chart chart(with_law(law), PlotKind::law);
  const auto lines = chart.lines("series-line");
  ASSERT_THAT(lines, SizeIs(1));
  const double pixel_x = std::abs(Chart::value(chart.x, 1) - Chart::value(chart.x, 0));
  EXPECT_NEAR(lines[0].front().first, -reach, 0.05 * pixel_x);
  EXPECT_NEAR(lines[0].back().first, reach, 0.05 * pixel_x);
  for (const auto& [w, p] : lines[0]) {
    // a hundredth of a pixel across is more upward where the curve is steep
    const double expected = std::copysign(formula(std::abs(w)), w);
    const double steep = std::abs(formula(std::abs(w) + 0.02 * pixel_x) - std::abs(expected));
    EXPECT_NEAR(chart.y.pixel(p), chart.y.pixel(expected),
                0.1 + std::abs(chart.y.pixel(steep) - chart.y.pixel(0)))
        << w;
  }
}

TEST(LawFigure, CurvesAreTheFormulasOfTheGuideOnBothSides) {
  const double k = 500;
  const double most = 2.5;
  const auto law = [&](const char* type) {
    return json{{"type", type}, {"stiffness", k}, {"capacity", most}};
  };
  expect_curve(
      law("tanh"), [&](double w) { return most * std::tanh(k * w / most); }, 1.2 * 1.5 * most / k);
  expect_curve(
      law("hyperbolic"), [&](double w) { return w / (1 / k + w / most); }, 1.2 * 9 * most / k);
  json power = law("power");
  power["reference"] = 0.05;
  power["exponent"] = 0.5;
  expect_curve(
      power,
      [&](double w) {
        return std::min({k * w, most * std::sqrt(w / 0.05), most});
      },
      1.2 * 0.05);
}

/// A spring that pushes beyond a gap of 0.02: a table, of which the figure marks the points.
json table_model() {
  return {{"nodes", json::array()},
          {"units", {{"length", "m"}, {"force", "kN"}}},
          {"springs",
           {{{"id", "soft"}, {"direction", {1, 0}}, {"stiffness", 5}},
            {{"id", "stop"},
             {"direction", {1, 0}},
             {"reaction", "compression_only"},
             {"gap", 0.02},
             {"law", {{"type", "table"}, {"points", {{0.01, 4}, {0.03, 9}, {0.06, 10}}}, {"factor", 2}}}},
            {{"id", "turn"},
             {"direction", "rotation"},
             {"reaction", "tension_only"},
             {"law", {{"type", "tanh"}, {"stiffness", 100}, {"capacity", 20}}}}}}};
}

TEST(LawFigure, AOneSidedSupportReactsBeyondItsGap) {
  const Chart chart(table_model(), PlotKind::law);  // the first with a law is the second spring
  EXPECT_THAT(chart.svg.texts(), Contains("Law of stop: table, compression only"));
  EXPECT_THAT(chart.svg.texts(), Contains("displacement w (m)"));
  EXPECT_THAT(chart.svg.texts(), Contains("reaction p (kN)"));
  EXPECT_THAT(chart.svg.with("series-dot"), SizeIs(3));
  EXPECT_TRUE(chart.has_dot("series-dot", 0.03, 8));
  EXPECT_TRUE(chart.has_dot("series-dot", 0.05, 18));
  EXPECT_TRUE(chart.has_dot("series-dot", 0.08, 20));
  const auto line = chart.lines("series-line").at(0);
  const double reach = 1.2 * 0.06;
  EXPECT_NEAR(line.front().first, -0.25 * (0.02 + reach), 1e-4);
  EXPECT_NEAR(line.front().second, 0, 0.01);
  EXPECT_NEAR(line[1].first, 0.02, 1e-4) << "the line is straight up to the gap";
  EXPECT_NEAR(line[1].second, 0, 0.01);
  EXPECT_NEAR(line.back().first, 0.02 + reach, 1e-4);
  EXPECT_NEAR(line.back().second, 20, 0.01) << "constant beyond the last point";
}

TEST(LawFigure, ATensionOnlyRotationalSpringHasMomentsOfTheOtherSense) {
  PlotRequest plot;
  plot.law = "turn";
  const Chart chart(table_model(), PlotKind::law, plot);
  EXPECT_THAT(chart.svg.texts(), Contains("Law of turn: tanh, tension only"));
  EXPECT_THAT(chart.svg.texts(), Contains("rotation w (rad)"));
  EXPECT_THAT(chart.svg.texts(), Contains("moment p (kN\u202fm)"));
  const auto line = chart.lines("series-line").at(0);
  const double reach = 1.2 * 1.5 * 0.2;
  EXPECT_NEAR(line.front().first, -reach, 1e-3);
  EXPECT_NEAR(line.front().second, -20 * std::tanh(1.8), 0.02);
  EXPECT_NEAR(line.back().first, 0.25 * reach, 1e-3);
  EXPECT_NEAR(line.back().second, 0, 0.02);
}

TEST(LawFigure, NumbersThatVaryGiveThreeCurves) {
  const json request = testing::example_request("pile_in_soil");
  const Chart chart(request, PlotKind::law);
  EXPECT_THAT(chart.svg.texts(), Contains("Law of clay: tanh, bilateral"));
  for (const char* name : {"0\u00a0L", "0.5\u00a0L", "1\u00a0L"}) {
    EXPECT_THAT(chart.svg.texts(), Contains(name));
  }
  const auto lines = chart.lines("series-line");
  ASSERT_THAT(lines, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = 1 - 0.375 * static_cast<double>(i);  // 14.4, 9 and 3.6 kN/m
    EXPECT_NEAR(lines[i].back().second, 14.4 * share * std::tanh(1.8), 0.01) << i;
    EXPECT_NEAR(lines[i].back().first, 1.8 * 14.4 / 800, 1e-4) << i;
  }
  EXPECT_THAT(chart.svg.elements()[2].text, HasSubstr("Capacity 14.4\u00a0kN/m at 0\u00a0L."));
  json gap = with_law(request["model"]["foundations"][0]["law"]);
  gap["foundations"][0]["reaction"] = "compression_only";
  gap["foundations"][0]["gap"] = {{"along", {{0, 0}, {1, 0.1}}}};
  EXPECT_THAT(Chart(gap, PlotKind::law).svg.texts(), Contains("displacement w beyond the gap (m)"));
}

TEST(LawFigure, TheModelIsThatOfADocumentOrOfTheSolvedRequest) {
  const json request = testing::example_request("pile_in_soil");
  const json result = {{"summary", json::object()}, {"model", {{"title", request["model"]["title"]}}}};
  PlotRequest plot;
  plot.law = "friction";
  const std::string text = Chart::text_of(request, PlotKind::law, plot);
  EXPECT_THAT(text, HasSubstr("Law of friction"));
  EXPECT_EQ(Chart::text_of({{"model", request["model"]}}, PlotKind::law, plot), text);
  plot.solved_request = &request;
  EXPECT_EQ(Chart::text_of(result, PlotKind::law, plot), text);
  plot.solved_request = nullptr;
  EXPECT_THAT(Chart::text_of(request["model"], PlotKind::law, plot), HasSubstr("Law of friction"));
  EXPECT_THAT(error_of(result, PlotKind::law).rule(), HasSubstr("no model with nodes"));
  EXPECT_THAT(error_of(json::array(), PlotKind::law).rule(), HasSubstr("no model with nodes"));
  plot.solved_request = &request;
  EXPECT_THAT(error_of(testing::table_of_two(), PlotKind::law, plot).rule(),
              HasSubstr("no model with nodes"));
}

TEST(LawFigure, MistakesAreNamedByTheirPlaces) {
  PlotRequest plot;
  plot.law = "soft";
  EXPECT_EQ(error_of(table_model(), PlotKind::law, plot).pointer(), "/springs/0");
  EXPECT_THAT(error_of(table_model(), PlotKind::law, plot).rule(), HasSubstr("has a stiffness and no law"));
  plot.law = "rope";
  EXPECT_THAT(error_of(table_model(), PlotKind::law, plot).rule(), HasSubstr("are: stop, turn"));
  const json linear = {{"model", {{"nodes", json::array()}, {"springs", {table_model()["springs"][0]}}}}};
  EXPECT_EQ(error_of(linear, PlotKind::law).pointer(), "/model");
  EXPECT_THAT(error_of(linear, PlotKind::law).rule(), HasSubstr("no spring and no foundation"));
  const json solved = {{"model", with_law({{"type", "sine"}, {"stiffness", 1}, {"capacity", 1}})}};
  plot = {};
  plot.solved_request = &solved;
  EXPECT_EQ(error_of({{"summary", json::object()}}, PlotKind::law, plot).pointer(),
            "request:/model/foundations/0/law/type");
  struct Case {
    json law;
    const char* pointer;
    const char* rule;
  };
  const Case cases[] = {
      {{{"type", "tanh"}, {"stiffness", -1}, {"capacity", 1}}, "/stiffness", "negative"},
      {{{"type", "tanh"}, {"stiffness", 1}}, "/capacity", "missing"},
      {{{"type", "tanh"}, {"stiffness", 1}, {"capacity", 0}}, "", "zero"},
      {{{"type", "tanh"}, {"stiffness", {{"along", {{0, 1}, {0, 2}}}}}, {"capacity", 1}},
       "/stiffness/along/1/0",
       "more than the fraction"},
      {{{"type", "power"}, {"stiffness", 1}, {"capacity", 1}, {"reference", 1}, {"exponent", 1}},
       "/exponent",
       "less than 1"},
      {{{"type", "table"}, {"points", {{0, 0}}}}, "/points", "beside the origin"},
      {{{"type", "table"}, {"points", {{1, 2}, {1, 3}}}}, "/points/1/0", "ascend"},
      {{{"type", "table"}, {"points", {{1, 2}, {2, -1}}}}, "/points/1/1", "must not be negative"},
      {{{"type", "table"}, {"points", {{1, 2}}}, {"interpolation", "spline"}},
       "/interpolation",
       "monotone_cubic or linear"}};
  for (const Case& one : cases) {
    const PlotError error = error_of(with_law(one.law), PlotKind::law);
    EXPECT_EQ(error.pointer(), std::string("/foundations/0/law") + one.pointer) << one.law;
    EXPECT_THAT(error.rule(), HasSubstr(one.rule)) << one.law;
  }
}

TEST(StiffnessFigure, TheSoftestAndTheCriticalPointStandAtTheirLoads) {
  const json result = testing::solved_example("frame_nearly_unstable");
  const Chart chart(result, PlotKind::stiffness);
  const json& softest = result.at("summary").at("softest");
  chart.expect_mark("softest", softest.at("load_factor"), softest.at("stiffness_ratio"));
  chart.expect_mark("limit", result.at("critical_points")[0].at("load_factor"), 0);
  EXPECT_THAT(chart.svg.texts(), Contains("149.14 limit point"));
  EXPECT_THAT(chart.svg.texts(), Contains("109.91 softest, ratio 0.0399"));
  const auto line = chart.lines("stable").at(0);
  EXPECT_NEAR(line.front().first, 0, 0.02);
  EXPECT_NEAR(line.front().second, 1, 1e-4);
  EXPECT_NEAR(line.back().first, result.at("critical_points")[0].at("load_factor"), 0.02);
  EXPECT_NEAR(line.back().second, 0, 1e-4);
}

/// A path over five rows; the ratio of one is not known, and stability is lost at the load factor 3.
json rows_with_a_gap() {
  return {{"summary", json::object()},
          {"critical_points",
           {{{"type", "limit_max"},
             {"branch", 0},
             {"load_factor", 3},
             {"arc_length", 3},
             {"confirmed", true},
             {"monitors", json::object()}}}},
          {"branches",
           {{{"load_factor", {0, 1, 2, 2.5, 2.8}},
             {"arc_length", {0, 1, 2, 2.5, 4}},
             {"negative_eigenvalues", {0, 0, 0, 0, 1}},
             {"stiffness_ratio", {1, 0.6, nullptr, 0.3, -0.2}}}}}};
}

TEST(StiffnessFigure, ALineEndsWhereStabilityIsLostAndHasAGapWhereNoRatioIsKnown) {
  json result = rows_with_a_gap();
  const auto d_of = [](const Chart& chart) { return chart.svg.with("stable").at(0).attribute("d"); };
  const Chart parted(result, PlotKind::stiffness);
  const std::string two = d_of(parted);
  EXPECT_EQ(std::count(two.begin(), two.end(), 'M'), 2);
  const auto points = parted.lines("stable").at(0);
  ASSERT_THAT(points, SizeIs(4));
  const std::pair<double, double> expected[] = {{0, 1}, {1, 0.6}, {2.5, 0.3}, {3, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(points[i].first, expected[i].first, 1e-3);
    EXPECT_NEAR(points[i].second, expected[i].second, 1e-3);
  }
  parted.expect_mark("limit", 3, 0);
  result["branches"][0]["computed"] = {0, 1, 3, 4};  // the third row is a point of the cubic
  const std::string whole = d_of(Chart(result, PlotKind::stiffness));
  EXPECT_EQ(std::count(whole.begin(), whole.end(), 'M'), 1);
}

TEST(StiffnessFigure, ResultsWithoutRatiosAreToldWhy) {
  EXPECT_EQ(error_of(testing::solved_example("beck"), PlotKind::stiffness).pointer(),
            "/branches/0/stiffness_ratio");
  EXPECT_EQ(error_of(testing::solved_example("pipe_under_pressure"), PlotKind::stiffness).pointer(),
            "/branches");
  json result = rows_with_a_gap();
  result["branches"][0]["stiffness_ratio"] = {1, 2};
  EXPECT_EQ(error_of(result, PlotKind::stiffness).pointer(), "/branches/0/stiffness_ratio");
  const json failed = {{"summary", json::object()}, {"failure", {{"detail", "no start"}}}};
  EXPECT_EQ(error_of(failed, PlotKind::stiffness).pointer(), "/failure");
  EXPECT_THAT(error_of(testing::example_request("beck"), PlotKind::stiffness).rule(),
              HasSubstr("solve it first"));
  EXPECT_THAT(error_of(testing::table_of_two(), PlotKind::stiffness).rule(), HasSubstr("kind stiffness"));
}

// Beck's column without load is a cantilever: omega L^2 sqrt(m/EI) is 1.8751^2 and 4.6941^2.
TEST(FrequenciesFigure, FlutterBeginsWhereTwoFrequenciesMeet) {
  const json result = testing::solved_example("beck");
  const json& point = result.at("critical_points").at(0);
  const Chart chart(result, PlotKind::frequencies);
  const auto lines = chart.lines("stable");
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_NEAR(lines[0].front().second, 3.5160, 0.005);
  EXPECT_NEAR(lines[1].front().second, 22.034, 0.005);
  const auto flutter = chart.lines("unstable");
  ASSERT_THAT(flutter, SizeIs(2));
  for (const auto& line : flutter) {
    EXPECT_NEAR(line.front().first, point.at("load_factor"), 0.01);
  }
  const auto marks = chart.marks("flutter");
  ASSERT_THAT(marks, SizeIs(1));
  EXPECT_NEAR(marks[0].first, chart.x.pixel(point.at("load_factor")), kPixel);
  EXPECT_NEAR(marks[0].second, chart.y.pixel(lines[0].back().second), 0.2);
  EXPECT_THAT(chart.svg.texts(), Contains("20.051 flutter"));
  EXPECT_THAT(chart.svg.texts(), Contains("pair that flutters"));
}

TEST(FrequenciesFigure, RowsOfAVibrationAnalysisAreDotsInTheOrderOfTheirLoads) {
  const auto at = [](double load, const json& squares) {
    return json{{"load_factor", load}, {"frequencies", {{"omega_squared", squares}}}};
  };
  const json result = {{"summary", json::object()},
                       {"static", {{"load_factor", {0, 1, 2}}, {"negative_eigenvalues", {0, 0, 1}}}},
                       {"vibrations", {at(2, {-9, 4}), at(0, {1, 16}), at(1, {0.25, 9})}}};
  const Chart chart(result, PlotKind::frequencies);
  EXPECT_THAT(chart.svg.with("row"), SizeIs(6));
  EXPECT_TRUE(chart.has_dot("row", 0, 1));
  EXPECT_TRUE(chart.has_dot("row", 0, 4));
  EXPECT_TRUE(chart.has_dot("row", 1, 0.5));
  EXPECT_TRUE(chart.has_dot("row", 2, -3)) << "a motion that diverges";
  EXPECT_THAT(chart.svg.texts(), Contains("circular frequency, below 0: diverging"));
  const auto lines = chart.lines("stable");
  ASSERT_THAT(lines, SizeIs(2));
  ASSERT_THAT(lines[0], SizeIs(3));
  EXPECT_NEAR(lines[0][1].first, 1, 1e-3);
  EXPECT_NEAR(lines[0][1].second, 0.5, 1e-2);
  EXPECT_THAT(chart.svg.texts(), Not(Contains("pair that flutters")));
}

TEST(FrequenciesFigure, RowsWithoutFrequenciesAreGapsWhereTheyWereComputed) {
  json result = rows_with_a_gap();
  json& branch = result["branches"][0];
  const auto of = [](double square) { return json{{"omega_squared", {square}}}; };
  branch["frequencies"] = {of(16), of(9), nullptr, of(4), of(1)};
  EXPECT_THAT(Chart(result, PlotKind::frequencies).lines("stable"), SizeIs(2));
  branch["computed"] = {0, 1, 3, 4};
  const Chart whole(result, PlotKind::frequencies);
  EXPECT_THAT(whole.lines("stable"), SizeIs(1));
  EXPECT_THAT(whole.svg.with("row"), IsEmpty());
  branch["frequencies"].erase(4);
  EXPECT_EQ(error_of(result, PlotKind::frequencies).pointer(), "/branches/0/frequencies");
}

TEST(FrequenciesFigure, AFrequencyIsZeroAtABifurcation) {
  json request = testing::example_request("portal_sway");
  for (json& section : request["model"]["sections"]) {
    section["mass"] = 1.0;
  }
  request["analysis"]["output"]["frequencies"] = 2;
  const json result = testing::solved(request);
  const Chart chart(result, PlotKind::frequencies);
  const json& point = result.at("critical_points")[0];
  ASSERT_EQ(point.at("type"), "bifurcation");
  const auto marks = chart.marks("bifurcation");
  ASSERT_THAT(marks, SizeIs(1));
  EXPECT_NEAR(marks[0].first, chart.x.pixel(point.at("load_factor")), kPixel);
  EXPECT_NEAR(marks[0].second, chart.y.pixel(0), 1.0);  // the root of a small square
  EXPECT_THAT(chart.svg.texts(), Contains("branch"));
}

TEST(FrequenciesFigure, ResultsWithoutFrequenciesAreToldWhatAsksForThem) {
  const auto error = [](const json& result) { return error_of(result, PlotKind::frequencies); };
  EXPECT_EQ(error(testing::solved_example("tunnel_arch")).pointer(), "/branches/0/frequencies");
  EXPECT_THAT(error(testing::solved_example("tunnel_arch")).rule(), HasSubstr("analysis.output.frequencies"));
  json request = testing::example_request("pile_in_soil");
  request["analysis"] = {{"type", "static"}, {"load_factors", {1}}};
  EXPECT_EQ(error(testing::solved(request)).pointer(), "/static/frequencies");
  EXPECT_EQ(error(testing::solved_example("frame_portal")).pointer(), "/vibrations");
  const json failed = {{"summary", json::object()}, {"failure", {{"detail", "no start"}}}};
  EXPECT_EQ(error(failed).pointer(), "/failure");
}

TEST(ChartFigures, AreTheSameTextEachTimeLightAndDark) {
  const json beck = testing::solved_example("beck");
  const json pile = testing::example_request("pile_in_soil");
  for (const bool dark : {false, true}) {
    PlotRequest plot;
    plot.dark = dark;
    const std::string law = Chart::text_of(pile, PlotKind::law, plot);
    const std::string frequencies = Chart::text_of(beck, PlotKind::frequencies, plot);
    const std::string stiffness = Chart::text_of(rows_with_a_gap(), PlotKind::stiffness, plot);
    EXPECT_EQ(Chart::text_of(pile, PlotKind::law, plot), law);
    EXPECT_EQ(Chart::text_of(beck, PlotKind::frequencies, plot), frequencies);
    EXPECT_EQ(Chart::text_of(rows_with_a_gap(), PlotKind::stiffness, plot), stiffness);
    for (const std::string& text : {law, frequencies, stiffness}) {
      EXPECT_THAT(text, Not(HasSubstr("nan")));
      EXPECT_THAT(text, HasSubstr(dark ? "figure dark" : "figure light"));
    }
  }
}

}  // namespace
}  // namespace snapthrough::api
