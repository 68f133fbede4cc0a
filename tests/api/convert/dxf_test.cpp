/// Lines, arcs and polylines of drawings, how their ends join, and what is refused by its line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "api/api.h"
#include "api/convert/convert.h"
#include "tests/api/convert/drawing.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using snapthrough::testing::drawing;
using snapthrough::testing::ends;
using snapthrough::testing::groups;
using snapthrough::testing::is_finding;
using snapthrough::testing::line;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

json converted(const std::string& text, const DxfOptions& options = {}) {
  const Conversion conversion = convert_dxf(text, options);
  EXPECT_THAT(conversion.findings, IsEmpty());
  return conversion.document == nullptr ? json::object() : *conversion.document;
}

TEST(ConvertDxf, LinesJoinToMembersAndNodes) {
  const json parts = converted(drawing(line(0, 0, 0, 4) + "; " + line(6, 4, 0, 4) + "; " + line(6, 4, 6, 0)));
  EXPECT_THAT(ends(parts), ElementsAre("1-2", "3-2", "3-4"));
  EXPECT_EQ(parts["nodes"], json::parse(R"([{"id": "1", "x": 0.0, "y": 0.0}, {"id": "2", "x": 0.0, "y": 4.0},
                                            {"id": "3", "x": 6.0, "y": 4.0}, {"id": "4", "x": 6.0, "y": 0.0}])"));
  EXPECT_EQ(parts["sections"], json::parse(R"([{"id": "wall"}])"));
  EXPECT_EQ(parts["members"][0]["section"], "wall");
  EXPECT_FALSE(parts["members"][0].contains("curve"));
}

// A drawing's arc turns to the left from its first angle to its second.
TEST(ConvertDxf, ArcsTurnToTheLeftFromTheirFirstAngle) {
  const json parts = converted(drawing("0 ARC; 8 0; 10 1; 20 2; 40 2; 50 330; 51 60"));
  EXPECT_NEAR(parts["members"][0]["curve"]["sweep_degrees"], 90.0, 1e-12);
  EXPECT_NEAR(parts["nodes"][0]["x"], 1.0 + std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(parts["nodes"][0]["y"], 1.0, 1e-14);
  EXPECT_NEAR(parts["nodes"][1]["x"], 2.0, 1e-14);
  EXPECT_NEAR(parts["nodes"][1]["y"], 2.0 + std::sqrt(3.0), 1e-14);
}

// A bulge is the tangent of a quarter of the angle: tan(45 degrees) = 1 for half a circle.
TEST(ConvertDxf, BulgesOfBothKindsOfPolylinesAreArcs) {
  const std::string light = drawing(
      "0 LWPOLYLINE; 8 0; 90 4; 70 0; 43 0.0; 10 0; 20 0; 10 2; 20 0; 42 1; 10 4; 20 0; 42 "
      "-0.4142135623730951;"
      "10 5; 20 1");
  const std::string old = drawing(
      "0 POLYLINE; 8 0; 66 1; 70 128; 10 0; 20 0; 30 0; 0 VERTEX; 8 0; 10 0; 20 0; 0 VERTEX; 8 0; 10 2; 20 0;"
      "42 1; 0 VERTEX; 8 0; 10 4; 20 0; 42 -0.4142135623730951; 0 VERTEX; 8 0; 10 5; 20 1; 0 SEQEND; 8 0");
  const json parts = converted(light);
  EXPECT_THAT(ends(parts), ElementsAre("1-2", "2-3", "3-4"));
  EXPECT_FALSE(parts["members"][0].contains("curve"));
  EXPECT_NEAR(parts["members"][1]["curve"]["sweep_degrees"], 180.0, 1e-12);
  EXPECT_NEAR(parts["members"][2]["curve"]["sweep_degrees"], -90.0, 1e-12);
  EXPECT_EQ(converted(old), parts);
}

TEST(ConvertDxf, EndsWithinTheToleranceAreOneNode) {
  const std::string text = drawing(line(0, 0, 1, 0) + "; " + line(1.004, 0.003, 2, 0));
  EXPECT_THAT(ends(converted(text)), ElementsAre("1-2", "3-4"));
  EXPECT_THAT(ends(converted(text, {{}, 0.004})), ElementsAre("1-2", "3-4"));
  const json joined = converted(text, {{}, 0.0051});
  EXPECT_THAT(ends(joined), ElementsAre("1-2", "2-3"));
  EXPECT_EQ(joined["nodes"][1]["x"], 1.0) << "the first point of a node is its place";
}

// Points on both sides of the borders of the cells that the search uses, at distances just inside and
// outside.
TEST(ConvertDxf, JoiningDependsOnTheDistanceOnly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < 200; ++i) {
    const double x = place(random);
    const double y = place(random);
    const double direction = angle(random);
    for (const double distance : {0.099, 0.101}) {
      const std::string text =
          drawing(line(100, 100, x, y) + "; " +
                  line(x + distance * std::cos(direction), y + distance * std::sin(direction), -100, 100));
      EXPECT_THAT(converted(text, {{}, 0.1})["nodes"], SizeIs(distance < 0.1 ? 3 : 4)) << x << ' ' << y;
    }
  }
}

TEST(ConvertDxf, LayersSelectAndNameSections) {
  const std::string text =
      drawing("0 TEXT; 8 notes; 1 plan; " + line(0, 0, 1, 0) +
              "; 0 LINE; 8 roof; 10 1; 20 0; 11 2; 21 0; 0 LINE; 8 axes; 10 5; 20 5; 11 6; 21 5");
  const json parts = converted(text, {{"wall", "roof"}, std::nullopt});
  EXPECT_THAT(ends(parts), ElementsAre("1-2", "2-3"));
  EXPECT_EQ(parts["sections"], json::parse(R"([{"id": "wall"}, {"id": "roof"}])"));
  EXPECT_THAT(convert_dxf(text, {{"floor"}, std::nullopt}).findings,
              ElementsAre(is_finding("--layer", "unknown_reference")));
}

TEST(ConvertDxf, OtherSectionsPaperSpaceAndLineEndsDoNotMatter) {
  std::string text = groups("0 SECTION; 2 BLOCKS; 0 LINE; 10 x; 0 ENDSEC") +
                     drawing("0 VIEWPORT; 67 1; 8 0; " + line(0, 0, 1, 0));
  const json expected = converted(drawing(line(0, 0, 1, 0)));
  EXPECT_EQ(converted(text), expected);
  for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 2)) {
    text.replace(i, 1, "\r\n");
  }
  EXPECT_EQ(converted(text), expected);
}

struct Mistake {
  const char* name;
  std::string text;
  const char* place;
  const char* code;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class ConvertDxfRefuses : public ::testing::TestWithParam<Mistake> {};

TEST_P(ConvertDxfRefuses, ByLineAndRule) {
  const Conversion conversion = convert_dxf(GetParam().text, {});
  EXPECT_EQ(conversion.document, nullptr);
  EXPECT_THAT(conversion.findings, ElementsAre(is_finding(GetParam().place, GetParam().code)));
}

// The first entity's type is on line 6.
INSTANTIATE_TEST_SUITE_P(
    Drawings, ConvertDxfRefuses,
    ::testing::Values(
        Mistake{"circle", drawing("0 CIRCLE; 8 0; 10 0; 20 0; 40 1"), "line 6", "unsupported"},
        Mistake{"second_entity", drawing(line(0, 0, 1, 0) + "; 0 SPLINE; 8 0"), "line 18", "unsupported"},
        Mistake{"closed", drawing("0 LWPOLYLINE; 8 0; 70 1; 10 0; 20 0; 10 1; 20 0; 10 1; 20 1"), "line 6",
                "closed"},
        Mistake{"closed_polyline",
                drawing("0 POLYLINE; 70 1; 0 VERTEX; 10 0; 20 0; 0 VERTEX; 10 1; 20 0; 0 SEQEND"), "line 6",
                "closed"},
        Mistake{"full_circle", drawing("0 ARC; 10 0; 20 0; 40 1; 50 0; 51 360"), "line 6", "closed"},
        Mistake{"zero_length", drawing(line(0, 0, 1, 0) + "; " + line(1, 0, 1, 0)), "line 18", "zero_length"},
        Mistake{"repeated_vertex", drawing("0 LWPOLYLINE; 10 0; 20 0; 10 0; 20 0; 10 1; 20 0"), "line 8",
                "zero_length"},
        Mistake{"one_vertex", drawing("0 LWPOLYLINE; 10 0; 20 0"), "line 6", "zero_length"},
        Mistake{"in_space", drawing("0 LINE; 10 0; 20 0; 30 0; 11 1; 21 0; 31 1"), "line 6", "out_of_range"},
        Mistake{"polyline_in_space",
                drawing("0 POLYLINE; 70 8; 0 VERTEX; 10 0; 20 0; 0 VERTEX; 10 1; 20 0; 0 SEQEND"), "line 6",
                "unsupported"},
        Mistake{"mirrored", drawing("0 ARC; 10 0; 20 0; 40 1; 50 0; 51 90; 210 0; 220 0; 230 -1"), "line 6",
                "unsupported"},
        Mistake{"number", drawing("0 LINE; 10 zero; 20 0; 11 1; 21 0"), "line 8", "wrong_type"},
        Mistake{"missing_number", drawing("0 LINE; 10 0; 20 0; 11 1"), "line 6", "missing_field"},
        Mistake{"group_code", groups("0 SECTION; 2 ENTITIES") + "zero\nLINE\n", "line 5", "malformed"},
        Mistake{"no_value", groups("0 SECTION; 2 ENTITIES") + "0", "line 5", "malformed"},
        Mistake{"no_end", groups("0 SECTION; 2 ENTITIES; 0 LINE"), "line 6", "malformed"},
        Mistake{"no_entities", groups("0 SECTION; 2 HEADER; 0 ENDSEC; 0 EOF"), "line 8", "malformed"},
        Mistake{"empty", drawing("0 POINT; 67 1"), "ENTITIES", "missing_field"},
        Mistake{"binary", "AutoCAD Binary DXF\r\n\x1A", "line 1", "malformed"},
        Mistake{"no_utf8", drawing("0 LINE; 8 W\xE4nde"), "line 1", "malformed"},
        Mistake{"layer", drawing("0 LINE; 8 ; 10 0; 20 0; 11 1; 21 0"), "line 6", "bad_id"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

// A request reader that is not the converter's finds the geometry that was drawn: the half circle of radius 1
// below the line from (0, 0) to (2, 0), whose sweep is to the left.
TEST(ConvertDxf, PartsAreReadWithoutFindings) {
  json request = {
      {"model", converted(drawing(line(-1, 0, 0, 0) + "; 0 ARC; 8 arc; 10 1; 20 0; 40 1; 50 180; 51 360"))},
      {"analysis", {{"type", "static"}}}};
  for (json& section : request["model"]["sections"]) {
    section.update({{"EA", 1e6}, {"EI", 1.0}});
  }
  request["model"]["supports"] = {{{"node", "1"}, {"fixed", {"x", "y", "rotation"}}}};
  request["model"]["loads"] = {{{"type", "point"}, {"at", {{"node", "3"}}}, {"force", {0, -1e-3}}}};
  EXPECT_THAT(read_request(request.dump()).findings, IsEmpty());
}

// Any text gives parts or findings, and neither harm nor an exception.
TEST(ConvertDxf, AnyTextIsAnswered) {
  const std::string sound = drawing(line(0, 0, 1, 0) +
                                    "; 0 LWPOLYLINE; 8 0; 10 1; 20 0; 42 1; 10 2; 20 0; 0 ARC; 8 0; "
                                    "10 3; 20 0; 40 1; 50 180; 51 270");
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    std::string text = sound;
    for (unsigned edits = 1 + random() % 4; edits > 0; --edits) {
      text[random() % text.size()] = "0123456789-.e\n Aq\xFF"[random() % 18];
    }
    text.resize(random() % 4 == 0 ? random() % text.size() : text.size());
    const Conversion conversion = convert_dxf(text, {{}, std::nullopt, i % 2 == 0});
    EXPECT_EQ(conversion.document == nullptr, !conversion.findings.empty()) << text;
    if (conversion.document != nullptr) {
      EXPECT_NO_THROW(static_cast<void>(conversion.document->dump()));
    }
  }
}

}  // namespace
}  // namespace snapthrough::api
