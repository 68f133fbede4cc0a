/// What figures draw between the numbers that a result lists: cubics between rows, extremes between places.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "api/plot/plot.h"
#include "api/plot/plot_request.h"
#include "tests/api/plot/documents.h"
#include "tests/api/plot/svg_reader.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using testing::SvgElement;
using testing::SvgReader;

/// A half circle of radius 1 about (1, 0) by five rows of its angle s, its rates the closed form's.
json half_circle(bool with_rates) {
  json branch{{"id", 0}, {"parent", nullptr}, {"termination", "steps"}, {"contact_fraction", json::object()}};
  for (const char* list : {"load_factor", "arc_length", "negative_eigenvalues", "stiffness_ratio"}) {
    branch[list] = json::array();
  }
  json rates{{"load_factor", json::array()}, {"monitors", {{"tip", json::array()}}}};
  branch["monitors"]["tip"] = json::array();
  for (int i = 0; i < 5; ++i) {
    const double s = std::numbers::pi * i / 4;
    branch["arc_length"].push_back(s);
    branch["load_factor"].push_back(std::sin(s));
    branch["monitors"]["tip"].push_back(1 - std::cos(s));
    branch["negative_eigenvalues"].push_back(0);
    branch["stiffness_ratio"].push_back(nullptr);
    rates["load_factor"].push_back(std::cos(s));
    rates["monitors"]["tip"].push_back(std::sin(s));
  }
  branch["computed"] = {0, 2, 4};
  if (with_rates) {
    branch["rates"] = rates;
  }
  return {{"summary", {{"critical_load_factor", nullptr}}},
          {"critical_points", json::array()},
          {"branches", {branch}},
          {"model", {{"title", ""}, {"units", json::object()}}}};
}

/// Largest difference of 1 from the distance of the drawn line's points, and of the middles between them,
/// from the circle's centre.
double off_circle(const json& result) {
  const std::string text = svg_of(result);
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  const double across = (x.pixel(2.0) - x.pixel(0.0)) / 2.0;
  const double up = y.pixel(1.0) - y.pixel(0.0);
  double largest = 0.0;
  for (const SvgElement& line : svg.with("stable")) {
    if (line.name != "path" || line.of.empty() || line.of.back() == "legend") {
      continue;
    }
    const auto points = testing::read_points(line.attribute("d"));
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double px = (0.5 * (points[i].first + points[i + 1].first) - x.pixel(1.0)) / across;
      const double py = (0.5 * (points[i].second + points[i + 1].second) - y.pixel(0.0)) / up;
      if (points.size() > 2) {
        largest = std::max(largest, std::abs(std::hypot(px, py) - 1.0));
      }
    }
  }
  return largest;
}

TEST(PathFigure, DrawsTheCubicsBetweenRows) {
  // the cubic leaves the circle by 2e-4 of the radius, pixels by 1e-3; straight lines by 1 - cos(pi/8) =
  // 0.076
  EXPECT_LT(off_circle(half_circle(true)), 0.003);
  EXPECT_GT(off_circle(half_circle(false)), 0.05);
}

/// A railway track yields sideways ever further along its path, whose load turns at a minimum within a
/// thousandth of its length: the cubics between rows do not turn back either.
TEST(PathRows, CubicsBesideASharpTurnDoNotTurnBack) {
  json request = testing::example_request("gallery/railway_track");
  request["analysis"].erase("output");  // no corrected points in between
  const json result = testing::solved(request);
  const json& branch = result["branches"][0];
  const auto arc = branch["arc_length"].get<std::vector<double>>();
  const auto middle = branch["monitors"]["middle"].get<std::vector<double>>();
  const auto rate = branch["rates"]["monitors"]["middle"].get<std::vector<double>>();
  double largest = middle[0];
  for (std::size_t i = 1; i < arc.size(); ++i) {
    const double h = arc[i] - arc[i - 1];
    for (const double t : {0.25, 0.5, 0.75, 1.0}) {
      const double value = (1 + 2 * t) * (1 - t) * (1 - t) * middle[i - 1] + t * t * (3 - 2 * t) * middle[i] +
                           h * t * (1 - t) * (1 - t) * rate[i - 1] + h * t * t * (t - 1) * rate[i];
      ASSERT_GE(value, largest - 1e-3 * middle.back()) << "row " << i;
      largest = std::max(largest, value);
    }
  }
}

TEST(PathFigure, MarksComputedRowsOnRequest) {
  PlotRequest plot;
  EXPECT_THAT(SvgReader(svg_of(half_circle(true), plot)).with("row"), ::testing::IsEmpty());
  plot.points = true;
  const std::string text = svg_of(half_circle(true), plot);
  const SvgReader svg(text);
  const auto [x, y] = testing::read_axes(svg);
  const auto dots = svg.with("row");
  ASSERT_EQ(dots.size(), 3U);
  EXPECT_NEAR(std::stod(std::string(dots[1].attribute("cx"))), x.pixel(1.0), 0.05);
  EXPECT_NEAR(std::stod(std::string(dots[1].attribute("cy"))), y.pixel(1.0), 0.05);
}

TEST(SectionsFigure, MarksExtremesBetweenPlaces) {
  json result = testing::solved_example("tunnel_arch");
  PlotRequest plot;
  plot.kind = PlotKind::sections;
  plot.state = 0;
  json& member = result["states"][0]["members"].begin().value();
  const json& moments = member["bending_moment"];
  double largest = 0.0;
  for (const json& moment : moments) largest = std::max(largest, moment.get<double>());
  const double s = 0.5 * (member["s"][2].get<double>() + member["s"][3].get<double>());
  member["extremes"]["bending_moment"]["max"] = {{"s", s}, {"value", std::ceil(3.0 * largest)}};
  const std::string text = svg_of(result, plot);
  EXPECT_THAT(
      SvgReader(text).texts(),
      ::testing::Contains(::testing::HasSubstr(std::to_string(static_cast<int>(std::ceil(3.0 * largest))))));
}

}  // namespace
}  // namespace snapthrough::api
