/// Drawings with segments that are drawn twice, with ends that are joined at a distance or lie on another
/// segment, and with ends that only look joined. Nodes, members and warnings are expected by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "api/api.h"
#include "api/convert/convert.h"
#include "solver/model/limits.h"
#include "solver/solve.h"
#include "tests/api/convert/drawing.h"
#include "tests/findings.h"

namespace snapthrough {

inline void PrintTo(const Warning& warning, std::ostream* out) {
  *out << warning.code << ": " << warning.detail;
}

namespace api {
namespace {

using nlohmann::json;
using snapthrough::testing::arc;
using snapthrough::testing::bulge;
using snapthrough::testing::drawing;
using snapthrough::testing::ends;
using snapthrough::testing::is_finding;
using snapthrough::testing::line;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr double kTolerance = 0.01;

Conversion converted(const std::vector<std::string>& entities, bool join_tees = false,
                     double tolerance = kTolerance) {
  Conversion conversion = convert_dxf(drawing(entities), {{}, tolerance, join_tees});
  EXPECT_THAT(conversion.findings, IsEmpty());
  if (conversion.document == nullptr) {
    conversion.document = std::make_shared<json>(json::object());
  }
  return conversion;
}

auto is_warning(const std::string& code, const std::string& begin, const std::string& part = "") {
  return AllOf(Field("code", &Warning::code, code),
               Field("detail", &Warning::detail, AllOf(StartsWith(begin), HasSubstr(part))));
}

const std::vector<std::string> kPortal{line(0, 0, 0, 4), line(0, 4, 6, 4), line(6, 4, 6, 0)};

std::vector<std::string> portal_with(const std::vector<std::string>& more) {
  std::vector<std::string> all = kPortal;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(DxfJoints, ASoundDrawingHasNoWarnings) {
  for (const bool join : {false, true}) {
    const Conversion portal = converted(kPortal, join);
    EXPECT_THAT(portal.warnings, IsEmpty());
    EXPECT_THAT(ends(*portal.document), ElementsAre("1-2", "2-3", "3-4"));
  }
}

// The tie is half a circle whose ends are computed from its centre: they differ from the feet by rounding.
TEST(DxfJoints, RoundingIsNoDistance) {
  EXPECT_THAT(converted(portal_with({arc(3, 0, 3, 180, 360)})).warnings, IsEmpty());
  const std::string sum = "0 LINE; 8 wall; 10 0.1; 20 0; 11 0.30000000000000004; 21 0";
  const std::string other = "0 LINE; 8 wall; 10 0.3; 20 0; 11 1; 21 0";
  const Conversion chain = converted({sum, other});
  EXPECT_THAT(chain.warnings, IsEmpty());
  EXPECT_THAT((*chain.document)["nodes"], SizeIs(3));
  // an arc of a long radius, whose end at (0, 0) is 1e5 sin(180 degrees) = 1.2e-11 off
  EXPECT_THAT(converted({line(-1, 0, 0, 0), arc(1e5, 0, 1e5, 179.99, 180)}).warnings, IsEmpty());
}

TEST(DxfJoints, SegmentsDrawnTwiceAreLeftOut) {
  const Conversion frame = converted(
      portal_with({line(0, 4, 0, 0), line(0, 4, 6, 4), arc(3, 0, 3, 180, 360), bulge(6, 0, 0, 0, -1)}));
  EXPECT_THAT(ends(*frame.document), ElementsAre("1-2", "2-3", "3-4", "1-4"));
  EXPECT_THAT(
      frame.warnings,
      ElementsAre(is_warning("duplicates_dropped",
                             "3 segments are drawn twice and are left out: line 42 on line 6 from (0, 4) to "
                             "(0, 0), line 54 on line 18 from (0, 4) to (6, 4), line 84 on line 66 from")));
}

TEST(DxfJoints, MessagesNameThreePlacesAndCountTheOthers) {
  const Conversion frame = converted(std::vector<std::string>(6, line(0, 0, 0, 4)));
  EXPECT_THAT(ends(*frame.document), ElementsAre("1-2"));
  EXPECT_THAT(frame.warnings,
              ElementsAre(is_warning("duplicates_dropped", "5 segments are drawn twice", " and 2 more; ")));
}

// A bulge b over a chord of length 2 has the rise b. The end of a line that is drawn again may be at 0.009.
TEST(DxfJoints, DuplicatesAreWithinTheToleranceEverywhere) {
  for (const double distance : {0.009, 0.011}) {
    const bool within = distance < kTolerance;
    EXPECT_THAT((*converted({line(0, 0, 2, 0), bulge(0, 0, 2, 0, distance)}).document)["members"],
                SizeIs(within ? 1 : 2));
    EXPECT_THAT(
        (*converted({bulge(0, 0, 2, 0, 0.5), bulge(2, 0, 0, 0, -0.5 - distance)}).document)["members"],
        SizeIs(within ? 1 : 2));
    EXPECT_THAT((*converted({line(0, 0, 2, 0), line(2, distance, 0, 0)}).document)["members"],
                SizeIs(within ? 1 : 2));
  }
  const Conversion mirrored = converted({bulge(0, 0, 2, 0, 0.5), bulge(2, 0, 0, 0, 0.5)});
  EXPECT_THAT((*mirrored.document)["members"], SizeIs(2)) << "arcs on both sides of their chord";
  EXPECT_THAT(mirrored.warnings, IsEmpty());
}

TEST(DxfJoints, ASegmentOfAnotherLayerStays) {
  const Conversion two = converted({line(0, 0, 2, 0), line(2, 0, 0, 0, "plate"), line(0, 0, 2, 0, "plate")});
  EXPECT_THAT(ends(*two.document), ElementsAre("1-2", "2-1"));
  EXPECT_THAT(two.warnings,
              ElementsAre(is_warning("duplicates_dropped", "1 segment is drawn twice", "line 30 on line 18"),
                          is_warning("stacked_members",
                                     "1 segment lies on one of another layer: line 18 on "
                                     "line 6 from (2, 0) to (0, 0)")));
}

TEST(DxfJoints, TheFirstOfEachLayerStays) {
  const std::vector<std::string> three{line(0, 0, 6, 0), line(0, 0, 6, 0, "plate"), line(0, 0, 6, 0)};
  const auto dropped = is_warning("duplicates_dropped", "1 segment is drawn twice", "line 30 on line 6");
  EXPECT_THAT(converted(three).warnings,
              ElementsAre(dropped, is_warning("stacked_members", "1 segment lies on one of another layer")));
  std::vector<std::string> tee = three;
  tee.push_back(line(3, 0, 3, 4));
  const Conversion divided = converted(tee, true);
  EXPECT_THAT(ends(*divided.document), ElementsAre("1-3", "3-2", "1-3", "3-2", "3-4"));
  EXPECT_THAT(divided.warnings,
              ElementsAre(dropped, is_warning("stacked_members", "2 segments lie on ones of another layer")));
}

TEST(DxfJoints, EndsThatAreJoinedAtADistanceAreTold) {
  const std::vector<std::string> chain{line(0, 0, 1, 0), line(1.004, 0.003, 2, 0), line(2, 0.002, 3, 0)};
  const Conversion joined = converted(chain);
  EXPECT_THAT(ends(*joined.document), ElementsAre("1-2", "2-3", "3-4"));
  EXPECT_THAT(joined.warnings,
              ElementsAre(is_warning("joined_ends",
                                     "2 ends are joined to nodes at other coordinates, the farthest at a "
                                     "distance of 0.005: (1.004, 0.003) at the segment of line 18",
                                     "tolerance 0.01")));
  EXPECT_THAT(converted({line(0, 0, 1, 0), line(1, 0.005, 2, 0)}).warnings,
              ElementsAre(is_warning("joined_ends", "1 end is joined to a node at other coordinates")));
}

TEST(DxfJoints, EndsInAlmostOnePlaceAreTold) {
  // the shorter segment has the length 2: 1e-3 of it is 0.002
  for (const double distance : {0.0019, 0.0021}) {
    const Conversion gap =
        converted({line(0, 0, 0, 3), "0 LINE; 8 wall; 10 0; 20 " + std::to_string(3 + distance) +
                                         "; 11 0; 21 " + std::to_string(5 + distance)},
                  true, 1e-3);
    EXPECT_THAT((*gap.document)["nodes"], SizeIs(4));
    if (distance > 0.002) {
      EXPECT_THAT(gap.warnings, IsEmpty());
    } else {
      EXPECT_THAT(gap.warnings, ElementsAre(is_warning("near_nodes",
                                                       "1 pair of ends lies in almost one place and is not "
                                                       "joined: (0, 3) and (0, 3.0019) at a distance of "
                                                       "0.0019",
                                                       "--tolerance, which is 0.001")));
    }
  }
}

TEST(DxfTees, EndsOnSegmentsAreTold) {
  const Conversion braced = converted(portal_with({line(0, 2, 3, 4), line(6, 2, 3, 4)}));
  EXPECT_THAT(ends(*braced.document), ElementsAre("1-2", "2-3", "3-4", "5-6", "7-6"));
  EXPECT_THAT(
      braced.warnings,
      ElementsAre(is_warning("tee_unjoined",
                             "3 ends lie on segments that they are not joined to: (0, 2) on the segment of "
                             "line 6, (3, 4) on the segment of line 18, (6, 2) on the segment of line 30; "
                             "--join-tees")));
}

TEST(DxfTees, TheOptionDividesLinesInTheirOrder) {
  const Conversion braced =
      converted(portal_with({line(0, 2, 4, 4), line(6, 2, 2, 4), line(0, 1, 6, 1)}), true);
  EXPECT_THAT(ends(*braced.document), ElementsAre("1-9", "9-5", "5-2", "2-8", "8-6", "6-3", "3-7", "7-10",
                                                  "10-4", "5-6", "7-8", "9-10"));
  EXPECT_THAT(braced.warnings,
              ElementsAre(is_warning("crossings",
                                     "1 crossing of segments has no end and is not joined: (3, "
                                     "3.5) of the segments of line 42 and line 54; ")));
}

TEST(DxfTees, AnEndWithinTheToleranceIsOnTheSegment) {
  for (const double distance : {0.009, 0.011}) {
    const Conversion tee = converted({line(0, 0, 20, 0), line(8, distance, 8, 20)}, true);
    if (distance < kTolerance) {
      EXPECT_THAT(ends(*tee.document), ElementsAre("1-3", "3-2", "3-4"));
      EXPECT_THAT(tee.warnings, ElementsAre(is_warning("tees_moved",
                                                       "1 segment is divided at an end that is not exactly "
                                                       "on it, the farthest at a distance of 0.009: (8, "
                                                       "0.009) at the segment of line 6")));
    } else {
      // 1e-3 of the shorter one is 0.02
      EXPECT_THAT(ends(*tee.document), ElementsAre("1-2", "3-4"));
      EXPECT_THAT(tee.warnings, ElementsAre(is_warning("tee_unjoined",
                                                       "1 end lies almost on a segment and is not joined to "
                                                       "it: (8, 0.011) at a distance of 0.011 from the "
                                                       "segment of line 6",
                                                       "--tolerance, which is 0.01")));
    }
  }
  EXPECT_THAT(converted({line(0, 0, 20, 0), line(8, 0.021, 8, 20)}).warnings, IsEmpty());
}

// Of a segment of length 2, 1e-3 is 0.002; an end near the end of another segment is told as such.
TEST(DxfTees, AlmostOnASegmentIsMeasuredByTheShorterOne) {
  EXPECT_THAT(converted({line(0, 0, 20, 0), line(8, 0.011, 8, 2)}).warnings, IsEmpty());
  EXPECT_THAT(converted({line(0, 0, 2, 0), line(1, 0.003, 1, 20)}, true, 1e-3).warnings, IsEmpty());
  EXPECT_THAT(converted({line(0, 0, 20, 0), line(0.01, 0.005, 0.01, 20)}, true, 1e-3).warnings,
              ElementsAre(is_warning("near_nodes", "1 pair of ends lies in almost one place")));
}

/// Returns the sweeps of the members, in degrees.
std::vector<double> sweeps(const json& parts) {
  std::vector<double> all;
  for (const json& member : parts.at("members")) {
    all.push_back(member.contains("curve") ? member["curve"]["sweep_degrees"].get<double>() : 0.0);
  }
  return all;
}

/// Returns the radius of a member's arc by its nodes and sweep: half the chord over the sine of half the
/// angle.
double radius_of(const json& parts, std::size_t member) {
  const auto node = [&](const char* end) {
    return parts["nodes"][std::stoul(parts["members"][member][end].get<std::string>()) - 1];
  };
  const json a = node("start");
  const json b = node("end");
  const double chord =
      std::hypot(b["x"].get<double>() - a["x"].get<double>(), b["y"].get<double>() - a["y"].get<double>());
  return chord / (2.0 * std::sin(0.5 * std::abs(sweeps(parts)[member]) * std::numbers::pi / 180.0));
}

// (3, 4) and (-4, 3) lie on the circle of radius 5, at 53.13 and 143.13 degrees.
TEST(DxfTees, ArcsAreDividedByTheirAngle) {
  const double first = std::atan2(4.0, 3.0) * 180.0 / std::numbers::pi;
  struct Case {
    std::string arc;
    std::vector<double> expected;
    std::vector<std::string> nodes;
  };
  // an arc from 0 to 270 degrees; half a circle to the left; and the same, drawn to the right
  const std::vector<Case> cases{
      {arc(0, 0, 5, 0, 270), {first, 90.0, 180.0 - first}, {"1-3", "3-5", "5-2"}},
      {bulge(5, 0, -5, 0, 1), {first, 90.0, 90.0 - first}, {"1-3", "3-5", "5-2"}},
      {bulge(-5, 0, 5, 0, -1), {first - 90.0, -90.0, -first}, {"1-5", "5-3", "3-2"}}};
  for (const Case& one : cases) {
    const Conversion arch = converted({one.arc, line(3, 4, 3, 8), line(-4, 3, -8, 3)}, true, 1e-6);
    const json& parts = *arch.document;
    EXPECT_THAT(arch.warnings, IsEmpty());
    std::vector<std::string> nodes = one.nodes;
    nodes.insert(nodes.end(), {"3-4", "5-6"});
    EXPECT_EQ(ends(parts), nodes);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(sweeps(parts)[i], one.expected[i], 1e-12) << i;
      EXPECT_NEAR(radius_of(parts, i), 5.0, 1e-12) << i;
    }
  }
}

// A circle of radius 1000 whose arc rises by 0.05: the end at mid-span on it, and one on its chord, which is
// not on it.
TEST(DxfTees, FlatArcsAreNotTheirChords) {
  const double half = std::sqrt(1000.0 * 1000.0 - 999.95 * 999.95);
  const auto flat = "0 ARC; 8 wall; 10 0; 20 -999.95; 40 1000; 50 " +
                    std::to_string(90.0 - std::asin(half / 1000.0) * 180.0 / std::numbers::pi) + "; 51 " +
                    std::to_string(90.0 + std::asin(half / 1000.0) * 180.0 / std::numbers::pi);
  EXPECT_THAT((*converted({flat, line(0, 0.05, 0, 9)}, true, 1e-4).document)["members"], SizeIs(3));
  EXPECT_THAT((*converted({flat, line(0, 0, 0, -9)}, true, 1e-4).document)["members"], SizeIs(2));
}

// A line that is drawn over a part of another one: their common part is one member.
TEST(DxfTees, OverlappingSegmentsBecomeOne) {
  const std::vector<std::string> over{line(0, 0, 6, 0), line(4, 0, 2, 0), line(3, 0, 8, 0)};
  EXPECT_THAT(ends(*converted(over, true).document), ElementsAre("1-4", "4-5", "5-3", "3-2", "2-6"));
  EXPECT_THAT(converted(over, true).warnings,
              ElementsAre(is_warning("duplicates_dropped", "4 segments are drawn twice")));
  EXPECT_THAT(converted(over).warnings, ElementsAre(is_warning("tee_unjoined", "6 ends lie on segments")));
}

// Ends on a ring that is drawn by two arcs of 180 degrees, every 10 degrees at other coordinates than those
// of its ends.
TEST(DxfTees, ARingIsDividedAtAllItsSpokes) {
  std::vector<std::string> wheel{arc(2, 1, 3, 0, 180), arc(2, 1, 3, 180, 360)};
  for (int k = 0; k < 36; ++k) {
    const double angle = (10.0 * k + 5.0) * std::numbers::pi / 180.0;
    json x = 2.0 + 3.0 * std::cos(angle);
    json y = 1.0 + 3.0 * std::sin(angle);
    wheel.push_back("0 LINE; 8 wall; 10 2; 20 1; 11 " + x.dump() + "; 21 " + y.dump());
  }
  const Conversion ring = converted(wheel, true, 1e-9);
  EXPECT_THAT(ring.warnings, IsEmpty());
  const json& parts = *ring.document;
  ASSERT_THAT(parts["members"], SizeIs(38 + 36));
  for (std::size_t i = 0; i < 38; ++i) {
    const bool at_end = i % 19 == 0 || i % 19 == 18;
    EXPECT_NEAR(sweeps(parts)[i], at_end ? 5.0 : 10.0, 1e-12) << i;
    EXPECT_NEAR(radius_of(parts, i), 3.0, 1e-12) << i;
  }
}

TEST(DxfCrossings, AreCountedAndNotJoined) {
  struct Case {
    const char* name;
    std::vector<std::string> entities;
    std::size_t crossings;
  };
  const std::vector<Case> cases{
      {"lines", {line(0, 0, 2, 2), line(0, 2, 2, 0)}, 1},
      {"line and arc", {line(-3, 1, 3, 1), arc(0, 0, 2, 0, 180)}, 2},
      {"line that ends in the arc", {line(0, 1, 3, 1), arc(0, 0, 2, 0, 180)}, 1},
      {"line that ends before the arc", {line(-1, 1, 1, 1), arc(0, 0, 2, 0, 180)}, 0},
      {"line beside the arc", {line(-3, -1, 3, -1), arc(0, 0, 2, 0, 180)}, 0},
      {"arcs", {arc(0, 0, 2, 0, 180), arc(2, 0, 2, 0, 180)}, 1},
      {"arcs twice", {arc(0, 0, 2, -90, 90), arc(2, 0, 2, 90, 270)}, 2},
      {"arc in an arc", {arc(0, 0, 2, 0, 180), arc(0, 0, 1, 0, 180)}, 0},
      {"touching", {line(-3, 2, 3, 2), arc(0, 0, 2, 0, 180)}, 1},
      {"touching within the tolerance", {line(-3, 2.005, 3, 2.005), arc(0, 0, 2, 0, 180)}, 1},
      {"not touching", {line(-3, 2.011, 3, 2.011), arc(0, 0, 2, 0, 180)}, 0},
      {"almost one circle", {arc(0, 0, 2, 0, 90), arc(0.0015, 0.0037, 2, 45, 135)}, 0},
      {"almost touching arcs", {arc(0, 0, 2, -90, 90), arc(1, 0, 1.005, -90, 90)}, 1},
      {"touching arcs", {arc(0, 0, 2, -90, 90), arc(4, 0, 2, 90, 270)}, 1},
      {"arc that touches from inside", {arc(0, 0, 2, -90, 90), arc(1, 0, 1, -90, 90)}, 1},
      {"parallel", {line(0, 0, 2, 2), line(0, 1, 2, 3)}, 0},
      {"common end", {line(0, 0, 2, 2), line(2, 2, 4, 0)}, 0},
      {"line that goes on in an arc", {line(-2, 2, 0, 2), arc(0, 0, 2, 0, 90)}, 0},
      {"arcs that go on", {arc(0, 0, 2, 0, 90), arc(0, -2, 4, 90, 120)}, 0},
      {"chord", {line(-2, 0, 2, 0), arc(0, 0, 2, 0, 180)}, 0},
      {"end at the crossing", {line(0, 0, 2, 2), line(0, 2, 2, 0), line(1, 1, 1, 5)}, 0}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    for (const bool join : {false, true}) {
      const Conversion conversion = converted(one.entities, join);
      std::vector<std::string> told;
      for (const Warning& warning : conversion.warnings) {
        if (warning.code == "crossings") {
          told.push_back(warning.detail);
        }
      }
      if (one.crossings == 0) {
        EXPECT_THAT(told, IsEmpty());
      } else {
        EXPECT_THAT(told, ElementsAre(StartsWith(std::to_string(one.crossings) + " crossing")));
        EXPECT_THAT((*conversion.document)["members"], SizeIs(2));
      }
    }
  }
}

/// Points of a line or arc from a start, at equal angles about its centre.
using Chain = std::vector<std::array<double, 2>>;

std::size_t crossings_of(const Chain& one, const Chain& other) {
  const auto side = [](const auto& a, const auto& b, const auto& p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0.0;
  };
  std::size_t count = 0;
  for (std::size_t i = 1; i < one.size(); ++i) {
    for (std::size_t j = 1; j < other.size(); ++j) {
      const auto &a = one[i - 1], &b = one[i], &c = other[j - 1], &d = other[j];
      count += side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b) ? 1 : 0;
    }
  }
  return count;
}

// Random lines and arcs, which cross as the chords of 400 parts of them do.
TEST(DxfCrossings, AreThoseOfManyChords) {
  std::mt19937 random(3);
  const auto number = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random() % 1000) / 1000.0;
  };
  std::size_t all = 0;
  for (int k = 0; k < 60; ++k) {
    std::vector<std::string> entities;
    std::vector<Chain> chains(6);
    std::size_t expected = 0;
    for (Chain& chain : chains) {
      const double x = number(-3, 3), y = number(-3, 3), p = number(-3, 3), q = number(-3, 3);
      const double turn = number(5, 355);
      const bool straight = random() % 3 == 0;
      const double radius = std::abs(p) + 0.3, from = 60.0 * q;
      entities.push_back(straight ? line(x, y, p, q) : arc(x, y, radius, from, from + turn));
      for (int i = 0; i <= 400; ++i) {
        const double t = i / 400.0, angle = (from + t * turn) * std::numbers::pi / 180.0;
        chain.push_back(straight ? std::array{x + t * (p - x), y + t * (q - y)}
                                 : std::array{x + radius * std::cos(angle), y + radius * std::sin(angle)});
      }
      for (const Chain* before = chains.data(); before != &chain; ++before) {
        expected += crossings_of(*before, chain);
      }
    }
    std::size_t counted = 0;
    for (const Warning& warning : converted(entities, false, 1e-7).warnings) {
      counted = warning.code == "crossings" ? std::stoul(warning.detail) : counted;
    }
    EXPECT_EQ(counted, expected) << k;
    all += expected;
  }
  EXPECT_GT(all, 100);
}

// An arc of radius 2 and a line both end at (0, 2), where they have almost one direction: the line is inside
// of the circle by 1e-8 at most and leaves it 4e-4 from there, which is no crossing at the tolerance 1e-6.
TEST(DxfCrossings, SmoothContinuationsAreNone) {
  EXPECT_THAT(converted({arc(0, 0, 2, 0, 90), line(0, 2, 2, 1.9998)}, false, 1e-6).warnings, IsEmpty());
}

// Circles through the same two ends, one of them flat: places of these ends, computed from the circles, are
// off by more than the tolerance.
TEST(DxfCrossings, ArcsBetweenTheSameEndsHaveNone) {
  std::vector<std::string> arcs{bulge(0, 0, 1, 0, 1e-5)};
  for (int k = 1; k <= 400; ++k) {
    arcs.push_back(bulge(0, 0, 1, 0, 0.0025 * k));
  }
  EXPECT_THAT(converted(arcs, false, 1e-9).warnings, IsEmpty());
}

// The circles are 0.007 from each other at (2, 0) and cross at 65 degrees, beyond the ends of the arcs, of
// which two lie on the other arc.
TEST(DxfCrossings, ATouchIsToldAtItsPlace) {
  EXPECT_THAT(
      converted({arc(0, 0, 2, -30, 30), arc(0.012, 0, 1.995, -40, 40)}).warnings,
      ElementsAre(is_warning("crossings", "1 crossing of segments has no end and is not joined: (2, "),
                  is_warning("tee_unjoined", "2 ends lie on segments")));
}

TEST(DxfCrossings, TheCountEnds) {
  std::vector<std::string> grid;
  for (int i = 1; i <= 101; ++i) {
    grid.push_back(line(i, 0, i, 102));
    grid.push_back(line(0, i, 102, i));
  }
  EXPECT_THAT(converted(grid).warnings,
              ElementsAre(is_warning("crossings", "10000 or more crossings of segments have no end")));
}

// 200 lines, each over all before it, have 200 * 199 ends on one another.
TEST(DxfTees, TooManyPartsAreRefused) {
  std::vector<std::string> nested;
  for (int i = 0; i < 200; ++i) {
    nested.push_back(line(-1.0 - i, 0, 1.0 + i, 0));
  }
  EXPECT_NE(converted(nested, false, 1e-3).document, nullptr);
  const Conversion divided = convert_dxf(drawing(nested), {{}, 1e-3, true});
  EXPECT_EQ(divided.document, nullptr);
  EXPECT_THAT(divided.findings, ElementsAre(is_finding("ENTITIES", "too_many")));
  EXPECT_THAT(divided.findings[0].detail, HasSubstr(std::to_string(kMaxMembers)));
}

/// Returns the lowest buckling load of a pinned column of height 2 whose brace, held at the wall, ends at
/// mid-height.
double buckling_load(bool join_tees) {
  const std::string wall = line(0, 0, 0, 2, "column");
  const Conversion drawn = converted({wall, line(1, 1, 0, 1, "brace")}, join_tees);
  json model = *drawn.document;
  const double column_area = 1e9;
  model["sections"] = {{{"id", "column"}, {"EA", column_area}, {"EI", 1.0}},
                       {{"id", "brace"}, {"EA", 1e6}, {"EI", 1.0}}};
  model["members"].back()["release"] = {{"end", {"rotation"}}};
  model["supports"] = {{{"node", "1"}, {"fixed", {"x", "y"}}},
                       {{"node", "2"}, {"fixed", {"x"}}},
                       {{"node", "3"}, {"fixed", {"x", "y", "rotation"}}}};
  model["loads"] = {{{"type", "point"}, {"at", {{"node", "2"}}}, {"force", {0, -1}}}};
  const json request = {{"model", model},
                        {"analysis", {{"type", "buckling"}, {"discretization", {{"accuracy", 1e-7}}}}}};
  const ReadOutcome read = read_request(request.dump());
  EXPECT_THAT(read.findings, IsEmpty());
  return read.findings.empty()
             ? solve(read.request->model, read.request->analysis).summary.critical_load_factor.value_or(0.0)
             : 0.0;
}

// Euler: pi^2 EI / L^2 for the column alone. The hinged brace, far stiffer than 16 pi^2 EI / L^3, holds its
// middle: two half-waves, four times the load. The column's shortening changes it by P / EA = 1e-8, and
// bends the brace by a force of some 3e-8 of the load.
TEST(DxfTees, AJoinedBraceRaisesTheBucklingLoadFourTimes) {
  const double euler = std::numbers::pi * std::numbers::pi / 4.0;
  EXPECT_NEAR(buckling_load(false) / euler, 1.0, 1e-6);
  EXPECT_NEAR(buckling_load(true) / (4.0 * euler), 1.0, 1e-6);
}

}  // namespace
}  // namespace api
}  // namespace snapthrough
