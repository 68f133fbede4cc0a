/// Figures of real results: what they show stands where a reader of the axes looks for it.

#include "api/plot/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

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
using testing::solved;
using testing::solved_example;
using testing::SvgElement;
using testing::SvgReader;

constexpr double kPixel = 0.05;  // coordinates are written to a hundredth, ticks at both ends of an axis

PlotRequest of_kind(PlotKind kind) {
  PlotRequest request;
  request.kind = kind;
  return request;
}

SvgReader read(const std::string& svg) { return SvgReader(svg); }

/// Middle of a mark by its corners: those of a triangle's height 11 stand 6.5 above and 4.5 below.
std::pair<double, double> middle_of(const SvgElement& mark) {
  const auto corners = testing::read_points(mark.attribute("d"));
  const bool down = corners[0].second > corners[1].second;
  const double reach = mark.is("limit") ? 6.5 : 7;
  return {corners[0].first, corners[0].second + (down ? -reach : reach)};
}

TEST(PathFigure, CriticalPointsStandAtTheirLoadsAndDisplacements) {
  const json result = solved_example("tunnel_arch");
  const std::string text = svg_of(result, of_kind(PlotKind::path));
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  std::vector<SvgElement> marks;
  for (const SvgElement& mark : svg.with("mark")) {
    if (!mark.of.empty() && mark.of.back() == "marks") {
      marks.push_back(mark);
    }
  }
  const json& points = result.at("critical_points");
  ASSERT_GT(points.size(), 2U);
  ASSERT_GE(marks.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [px, py] = middle_of(marks[i]);
    // the crown moves down: the axis shows minus the monitor's value
    EXPECT_NEAR(px, x.pixel(-points[i].at("monitors").at("crown").get<double>()), kPixel) << i;
    EXPECT_NEAR(py, y.pixel(points[i].at("load_factor")), kPixel) << i;
    EXPECT_TRUE(marks[i].is(points[i].at("type") == "bifurcation" ? "bifurcation" : "limit")) << i;
  }
  EXPECT_THAT(svg.texts(), Contains("93.12 limit point"));
}

TEST(PathFigure, StabilityChangesAtTheLimitPoint) {
  const json result = solved_example("buried_pipe");
  const std::string text = svg_of(result, of_kind(PlotKind::path));
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  const auto stable = svg.with("stable");
  const auto unstable = svg.with("unstable");
  const auto curve_of = [](const std::vector<SvgElement>& found) {
    std::vector<SvgElement> curves;
    std::copy_if(found.begin(), found.end(), std::back_inserter(curves),
                 [](const SvgElement& one) { return one.name == "path"; });
    return curves;
  };
  ASSERT_THAT(curve_of(stable), SizeIs(1));
  ASSERT_THAT(curve_of(unstable), SizeIs(1));
  const auto before = testing::read_points(curve_of(stable)[0].attribute("d"));
  const auto after = testing::read_points(curve_of(unstable)[0].attribute("d"));
  const json& point = result.at("critical_points")[0];
  EXPECT_EQ(before.back(), after.front());
  EXPECT_NEAR(before.back().first, x.pixel(-point.at("monitors").at("crown").get<double>()), kPixel);
  EXPECT_NEAR(before.back().second, y.pixel(point.at("load_factor")), kPixel);
  EXPECT_NEAR(before.front().first, x.pixel(0), kPixel);
  EXPECT_NEAR(before.front().second, y.pixel(0), kPixel);
}

// The number of negative eigenvalues is 0 on both sides of flutter.
TEST(PathFigure, ThePathIsUnstableBeyondFlutter) {
  const json result = solved_example("beck");
  const double load = result.at("critical_points").at(0).at("load_factor");
  const std::string text = svg_of(result, of_kind(PlotKind::path));
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  for (const char* looks : {"stable", "unstable"}) {
    const auto found = svg.with(looks);
    const auto curve =
        std::find_if(found.begin(), found.end(), [](const SvgElement& one) { return one.name == "path"; });
    ASSERT_NE(curve, found.end()) << looks;
    const auto points = testing::read_points(curve->attribute("d"));
    const auto& end = std::string_view(looks) == "stable" ? points.back() : points.front();
    EXPECT_NEAR(end.second, y.pixel(load), kPixel) << looks;
  }
  EXPECT_THAT(svg.with("flutter"), SizeIs(2)) << "the mark at its load and that of the legend";
}

TEST(PathFigure, BranchesAreDrawnAndOneCanBeChosen) {
  const json result = solved_example("portal_sway");
  ASSERT_GT(result.at("branches").size(), 1U);
  const std::string all = svg_of(result, of_kind(PlotKind::path));
  EXPECT_THAT(read(all).texts(), Contains("branch"));
  PlotRequest one = of_kind(PlotKind::path);
  one.branch = 0;
  const std::string first = svg_of(result, one);
  EXPECT_THAT(read(first).texts(), Not(Contains("branch")));
  one.branch = result.at("branches").size();
  try {
    (void)svg_of(result, one);
    FAIL();
  } catch (const PlotError& error) {
    EXPECT_EQ(error.pointer(), "/branches/" + std::to_string(*one.branch));
  }
}

TEST(PathFigure, TheRequestGivesTheMonitorsSenseAndUnit) {
  const json request = testing::example_request("buried_pipe");
  const json result = solved(request);
  PlotRequest plot = of_kind(PlotKind::path);
  EXPECT_THAT(read(svg_of(result, plot)).texts(), Contains("\u2212crown"));
  plot.solved_request = &request;
  EXPECT_THAT(read(svg_of(result, plot)).texts(), Contains("crown, down (m)"));
  plot.over_arc_length = true;
  EXPECT_THAT(read(svg_of(result, plot)).texts(), Contains("arc length of the path"));
}

TEST(SectionsFigure, ExtremesAreThoseOfTheState) {
  const json result = solved_example("buried_pipe");
  const std::string text = svg_of(result, of_kind(PlotKind::sections));
  const SvgReader svg(text);
  const json& state = result.at("states").at(result.at("critical_points")[0].at("state").get<std::size_t>());
  for (const auto& [field, looks] :
       {std::pair("axial_force", "section-N"), std::pair("shear_force", "section-Q"),
        std::pair("bending_moment", "section-M")}) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const auto& [id, member] : state.at("members").items()) {
      low = std::min(low, member.at("extremes").at(field).at("min").at("value").get<double>());
      high = std::max(high, member.at("extremes").at(field).at("max").at("value").get<double>());
    }
    std::vector<double> written;
    for (const SvgElement& one : svg.elements()) {
      if (one.is("section-value") &&
          std::find(one.of.begin(), one.of.end(), std::string("section ") + looks) != one.of.end()) {
        written.push_back(testing::written_number(one.text));
      }
    }
    ASSERT_THAT(written, SizeIs(2)) << field;
    EXPECT_NEAR(written[0], high, 5e-4 * std::abs(high)) << field;  // four digits are written
    EXPECT_NEAR(written[1], low, 5e-4 * std::abs(low)) << field;
  }
}

/// Lengths of the drawn pieces of contact over those of the undeformed member, in model units by the
/// drawing's width.
TEST(ShapeFigure, ContactAndItsSideAreFoundWithoutTheRequest) {
  const json request = testing::example_request("tunnel_arch");
  const json result = solved(request);
  PlotRequest plot = of_kind(PlotKind::shape);
  plot.state = result.at("critical_points")[0].at("state").get<std::size_t>();
  const json& soil = result.at("states").at(*plot.state).at("foundations").begin().value();
  for (const json* model : {static_cast<const json*>(nullptr), &request}) {
    plot.solved_request = model;
    const std::string text = svg_of(result, plot);
    const SvgReader svg(text);
    EXPECT_THAT(svg.with("contact"), SizeIs(soil.at("contact").size()));
    ASSERT_THAT(svg.with("reaction-line"), SizeIs(1));
    const auto tips = testing::read_points(svg.with("reaction-line")[0].attribute("d"));
    const auto base = testing::read_points(svg.with("member")[0].attribute("d"));
    double highest_tip = INFINITY;
    double highest_base = INFINITY;
    for (const auto& [x, y] : tips) {
      highest_tip = std::min(highest_tip, y);
    }
    for (const auto& [x, y] : base) {
      highest_base = std::min(highest_base, y);
    }
    EXPECT_LT(highest_tip, highest_base - 20) << "the ground lies above the arch";
    EXPECT_EQ(svg.with("ground-hatch").empty(), model == nullptr);
    EXPECT_EQ(svg.with("support-force").empty(), model != nullptr);
  }
}

/// The pile of the examples at load factors below its limit point.
json solved_pile(const json& load_factors) {
  json request = testing::example_request("pile_in_soil");
  request["analysis"] = {{"type", "static"}, {"load_factors", load_factors}};
  return solved(request);
}

TEST(ShapeFigure, FactorOfDisplacementsIsWritten) {
  const json result = solved_pile({1});
  EXPECT_THAT(svg_of(result, of_kind(PlotKind::shape)), HasSubstr("displacements \u00d7 100"));
  PlotRequest plot = of_kind(PlotKind::shape);
  plot.magnify = 1;
  EXPECT_THAT(svg_of(result, plot), HasSubstr("true scale"));
}

TEST(ShapeFigure, TheDefaultStateIsTheFirstCriticalPointOrTheLast) {
  const json arch = solved_example("tunnel_arch");
  EXPECT_THAT(svg_of(arch, of_kind(PlotKind::shape)), HasSubstr("at load factor 93.12 (limit point)"));
  const json pile = solved_pile({0.5, 1});
  EXPECT_THAT(svg_of(pile, of_kind(PlotKind::shape)), HasSubstr("at load factor 1,"));
}

// A cantilever along x that a force bends up: the arrow is across the axis at the tip, whose rotation the
// result has, or keeps its direction.
TEST(ShapeFigure, AFollowingForceTurnsWithItsPlace) {
  json request = testing::example_request("beck");
  request["model"]["nodes"][1] = {{"id", "tip"}, {"x", 1}, {"y", 0}};
  request["model"]["loads"][0]["force"] = {0, 1};
  request["analysis"] = {{"type", "static"}, {"load_factors", {2}}};
  PlotRequest plot = of_kind(PlotKind::shape);
  plot.solved_request = &request;
  for (const bool follows : {false, true}) {
    request["model"]["loads"][0]["follows"] = follows;
    const json result = solved(request);
    const double rotation = result["states"][0]["members"]["column"]["rotation"].back();
    ASSERT_GT(rotation, 0.5);
    const std::string text = svg_of(result, plot);
    const SvgReader svg(text);
    ASSERT_THAT(svg.with("load"), SizeIs(1));
    const auto arrow = testing::read_points(svg.with("load")[0].attribute("d"));
    const double angle = std::atan2(arrow[0].second - arrow[1].second, arrow[1].first - arrow[0].first);
    EXPECT_NEAR(angle, 0.5 * M_PI + (follows ? rotation : 0.0), 2e-3) << follows;
  }
}

TEST(ShapeFigure, AnotherRequestIsRefused) {
  const json other = testing::example_request("frame_portal");
  PlotRequest plot = of_kind(PlotKind::shape);
  plot.solved_request = &other;
  try {
    (void)svg_of(solved_example("buried_pipe"), plot);
    FAIL();
  } catch (const PlotError& error) {
    EXPECT_EQ(error.pointer(), "request:/model/members");
    EXPECT_THAT(error.rule(), HasSubstr("not the request of this result"));
  }
}

TEST(ModelFigure, SaysThatCablesAreStraight) {
  json request = {{"model",
                   {{"nodes", {{{"id", "a"}, {"x", 0}, {"y", 0}}, {{"id", "b"}, {"x", 9}, {"y", 1}}}},
                    {"sections", {{{"id", "rope"}, {"EA", 100}, {"EI", 1}, {"mass", 1}}}},
                    {"members", {{{"id", "span"}, {"start", "a"}, {"end", "b"}, {"section", "rope"}}}}}}};
  EXPECT_THAT(svg_of(request, of_kind(PlotKind::model)), Not(HasSubstr("cables")));
  request["model"]["members"][0]["cable"] = true;
  const std::string text = svg_of(request, of_kind(PlotKind::model));
  EXPECT_THAT(text, HasSubstr("cables as straight lines"));
  EXPECT_THAT(read(text).with("hinge"), SizeIs(2));
}

TEST(ModeFigure, BucklingModesAreDrawnOnTheStructureOrAlongTheMembers) {
  const json request = testing::example_request("frame_portal");
  const json result = solved(request);
  PlotRequest plot;  // the default of a buckling analysis
  const std::string panels = svg_of(result, plot);
  EXPECT_THAT(read(panels).texts(), Contains("displacement u, to the right"));
  plot.solved_request = &request;
  const std::string drawing = svg_of(result, plot);
  EXPECT_THAT(read(drawing).with("mode"), SizeIs(3));
  EXPECT_THAT(drawing, HasSubstr("Buckling mode 1 at load factor"));
  plot.mode = 1;
  EXPECT_THAT(svg_of(result, plot), HasSubstr("Buckling mode 2 at load factor"));
}

TEST(ModeFigure, MotionsOfAllLoadFactorsAreCounted) {
  json request = testing::example_request("beck");
  request["analysis"] = {{"type", "vibration"}, {"load_factors", {0, 10}}, {"modes", 2}};
  const json result = solved(request);
  PlotRequest plot = of_kind(PlotKind::mode);
  plot.mode = 3;
  EXPECT_THAT(svg_of(result, plot), HasSubstr("Natural motion 2 at load factor 10"));
  plot.mode = 4;
  EXPECT_THROW((void)svg_of(result, plot), PlotError);
}

TEST(SweepFigure, DotsStandAtTheirValues) {
  json table = testing::table_of_two();
  PlotRequest plot = of_kind(PlotKind::sweep);
  const std::string text = svg_of(table, plot);
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  std::vector<std::pair<double, double>> expected;
  for (const double t : {0.1, 0.2, 0.3}) {
    for (const json& row : table.at("rows")) {
      if (row[1] == t && !row[2].is_null()) {
        expected.emplace_back(x.pixel(row[0], true), y.pixel(row[2]));
      }
    }
  }
  const std::vector<SvgElement> dots = svg.with("series-dot");
  ASSERT_THAT(dots, SizeIs(expected.size()));
  for (std::size_t i = 0; i < dots.size(); ++i) {
    EXPECT_NEAR(dots[i].number("cx"), expected[i].first, kPixel);
    EXPECT_NEAR(dots[i].number("cy"), expected[i].second, kPixel);
  }
  EXPECT_THAT(svg.texts(), Contains("t = 0.2"));
  EXPECT_THAT(svg.texts(), Contains("1 failed: 1 no_start"));
  const auto crosses = testing::read_points(svg.with("failed")[0].attribute("d"));
  EXPECT_NEAR((crosses[0].first + crosses[1].first) / 2, x.pixel(10, true), 0.51);  // at a whole pixel
}

/// Two curves of a refined sweep; the first jumps between its third and fourth row.
json refined_table() {
  return json::parse(R"({
    "columns": ["k", "gap", "/summary/critical_load_factor", "piece", "change", "error"],
    "rows": [[1, 0.0, 9.0, 0, null, null], [1, 0.5, 8.0, 0, null, null], [1, 0.75, 7.5, 0, null, null],
             [1, 0.751, 4.0, 1, "jump, type: bifurcation to limit_max", null], [1, 1.0, 3.0, 1, null, null],
             [2, 0.0, 2.0, 0, null, null], [2, 0.4, 2.5, 0, null, null], [2, 1.0, 2.0, 0, null, null]]})");
}

TEST(SweepFigure, LinesBreakBetweenPiecesAndSayWhatChanges) {
  PlotRequest plot = of_kind(PlotKind::sweep);
  plot.x = "gap";
  const std::string text = svg_of(refined_table(), plot);
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  const std::vector<SvgElement> lines = svg.with("series-line");
  std::size_t parts = 0;
  for (const SvgElement& line : lines) {
    const std::string d = line.attribute("d");
    parts += static_cast<std::size_t>(std::count(d.begin(), d.end(), 'M'));
  }
  EXPECT_EQ(parts, 3U) << "two pieces and a curve";
  const std::vector<SvgElement> rings = svg.with("break-mark");
  ASSERT_THAT(rings, SizeIs(2));
  EXPECT_NEAR(rings[0].number("cx"), x.pixel(0.75), kPixel);
  EXPECT_NEAR(rings[0].number("cy"), y.pixel(7.5), kPixel);
  EXPECT_NEAR(rings[1].number("cx"), x.pixel(0.751), kPixel);
  EXPECT_NEAR(rings[1].number("cy"), y.pixel(4.0), kPixel);
  EXPECT_THAT(svg.texts(), Contains("jump, type: bifurcation to limit_max"));
  EXPECT_THAT(text, HasSubstr("One break: jump, type: bifurcation to limit_max."));
}

/// Only the columns between the outputs and the error are those of a refined sweep.
TEST(SweepFigure, AParameterMayBeNamedPiece) {
  json table = refined_table();
  table["columns"] = {"piece", "gap", "/summary/critical_load_factor", "/a", "/b", "error"};
  PlotRequest plot = of_kind(PlotKind::sweep);
  plot.x = "gap";
  const SvgReader svg = read(svg_of(table, plot));
  EXPECT_THAT(svg.with("break-mark"), IsEmpty());
  EXPECT_THAT(svg.texts(), Contains("piece = 2"));
}

TEST(SweepFigure, RowsAreChosenByAValue) {
  PlotRequest plot = of_kind(PlotKind::sweep);
  plot.where = {{"t", "0.10"}};
  EXPECT_THAT(read(svg_of(testing::table_of_two(), plot)).with("series"), SizeIs(1));
  plot.where = {{"t", "0.4"}};
  EXPECT_THROW((void)svg_of(testing::table_of_two(), plot), PlotError);
}

/// Boxes of a path of rectangles "Mx yHxVyHxZ": left, bottom, right, top.
std::vector<std::array<double, 4>> boxes_of(const std::string& d) {
  std::vector<std::array<double, 4>> boxes;
  for (std::size_t at = d.find('M'); at != std::string::npos; at = d.find('M', at + 1)) {
    std::array<double, 4> box{};
    EXPECT_EQ(std::sscanf(d.c_str() + at, "M%lf %lfH%lfV%lf", &box[0], &box[1], &box[2], &box[3]), 4);
    boxes.push_back(box);
  }
  return boxes;
}

TEST(HeatmapFigure, FailedCellsAreHatchedWhereTheyAre) {
  PlotRequest plot = of_kind(PlotKind::heatmap);
  const std::string text = svg_of(testing::table_of_two(), plot);
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  const std::vector<SvgElement> failed = svg.with("failed-cell");
  ASSERT_THAT(failed, SizeIs(2));  // the cell, and that of the key
  const auto boxes = boxes_of(failed[0].attribute("d"));
  ASSERT_THAT(boxes, SizeIs(1));
  const auto [left, bottom, right, top] = boxes[0];
  EXPECT_NEAR((left + right) / 2, x.pixel(10, true), kPixel);
  EXPECT_NEAR((bottom + top) / 2, y.pixel(0.2), kPixel);
  const auto hatch = testing::read_points(svg.with("failed-hatch")[0].attribute("d"));
  ASSERT_FALSE(hatch.empty());
  for (const auto& [px, py] : hatch) {
    EXPECT_TRUE(px >= left - 0.01 && px <= right + 0.01 && py >= top - 0.01 && py <= bottom + 0.01);
  }
  EXPECT_THAT(svg.texts(), Contains("no value"));
}

TEST(HeatmapFigure, DarkerCellsHaveLargerValues) {
  const json table = testing::table_of_two();
  const std::string text = svg_of(table, of_kind(PlotKind::heatmap));
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  for (const json& row : table.at("rows")) {
    if (row[2].is_null()) {
      continue;
    }
    int found = -1;
    for (int band = 0; band < 12; ++band) {
      for (const SvgElement& cells : svg.with("band-" + std::to_string(band))) {
        for (const auto& [left, bottom, right, top] :
             cells.name == "path" ? boxes_of(cells.attribute("d")) : boxes_of("")) {
          const double px = x.pixel(row[0], true);
          const double py = y.pixel(row[1]);
          found = px > left && px < right && py > top && py < bottom ? band : found;
        }
      }
    }
    // values to 300 in bands of 50 that share twelve colours evenly: the band is the colour over 11/5
    const double value = row[2];
    EXPECT_EQ(found, static_cast<int>(std::round(std::min(5.0, std::floor(value / 50)) * 11 / 5))) << value;
  }
}

TEST(Figure, EveryKindIsTheSameTextEachTime) {
  const json arch = solved_example("tunnel_arch");
  for (const PlotKind kind : {PlotKind::path, PlotKind::shape, PlotKind::sections, PlotKind::mode}) {
    const std::string text = svg_of(arch, of_kind(kind));
    EXPECT_EQ(text, svg_of(json::parse(arch.dump()), of_kind(kind)));
    EXPECT_NO_THROW((void)read(text));
  }
  for (const PlotKind kind : {PlotKind::sweep, PlotKind::heatmap}) {
    EXPECT_EQ(svg_of(testing::table_of_two(), of_kind(kind)), svg_of(testing::table_of_two(), of_kind(kind)));
  }
}

TEST(Figure, EveryExampleHasItsDefaultFigure) {
  for (const char* name : {"arch_no_base", "beck", "buried_pipe", "column_between_walls", "column_winkler",
                           "film_on_substrate", "frame_nearly_unstable", "frame_portal", "pile_in_soil",
                           "pipe_under_pressure", "pipeline_upheaval", "portal_sway", "tunnel_arch"}) {
    const json request = testing::example_request(name);
    const json result = solved(request);
    PlotRequest plot;
    plot.solved_request = &request;
    for (const bool dark : {false, true}) {
      plot.dark = dark;
      const std::string text = svg_of(result, plot);
      EXPECT_NO_THROW((void)read(text)) << name;
      EXPECT_THAT(text, Not(HasSubstr("nan"))) << name;
      EXPECT_THAT(read(text).elements()[1].name, "title") << name;
    }
  }
}

TEST(Figure, DefaultKindFitsTheDocument) {
  EXPECT_EQ(default_plot_kind(solved_example("tunnel_arch")), PlotKind::path);
  EXPECT_EQ(default_plot_kind(solved_example("frame_portal")), PlotKind::mode);
  EXPECT_EQ(default_plot_kind(solved_example("pipe_under_pressure")), PlotKind::shape);
  json request = testing::example_request("pile_in_soil");
  request["analysis"] = {{"type", "static"}, {"load_factors", {1}}};
  EXPECT_EQ(default_plot_kind(solved(request)), PlotKind::shape);
  EXPECT_EQ(default_plot_kind(testing::table_of_two()), PlotKind::sweep);
  json wide = {{"columns", {"a", "b", "/x", "error"}}, {"rows", json::array()}};
  for (int a = 0; a < 7; ++a) {
    for (int b = 0; b < 7; ++b) {
      wide["rows"].push_back({a, b, a + b, nullptr});
    }
  }
  EXPECT_EQ(default_plot_kind(wide), PlotKind::heatmap);
}

TEST(Figure, StylesAreInsideAndDoNotReachOtherFigures) {
  const std::string text = svg_of(solved_example("buried_pipe"), {});
  const SvgReader svg(text);
  EXPECT_THAT(text, Not(HasSubstr("href")));
  EXPECT_THAT(text, Not(HasSubstr("url(")));
  std::string rules;
  for (const SvgElement& one : svg.elements()) {
    rules += one.name == "style" ? one.text : "";
  }
  std::istringstream lines(rules);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(line.empty() || line.starts_with(".figure.light") || line.starts_with("@") || line == "}")
        << line;
    EXPECT_EQ(line.find('$'), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace snapthrough::api
