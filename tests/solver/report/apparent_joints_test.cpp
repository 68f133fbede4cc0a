/// Places that look joined and are not: small structures whose drawing shows the place.
#include "solver/report/apparent_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace snapthrough {
namespace {

Member member(const std::string& id, const std::string& start, const std::string& end,
              const Curve& curve = LineCurve{}) {
  Member out;
  out.id = id;
  out.start = start;
  out.end = end;
  out.section = "s";
  out.curve = curve;
  return out;
}

Model model_of(std::vector<Node> nodes, std::vector<Member> members) {
  Model out;
  out.nodes = std::move(nodes);
  out.sections = {{"s", 1.0, 1.0, {}}};
  out.members = std::move(members);
  return out;
}

std::vector<std::string> texts(const Model& model) {
  std::vector<std::string> out;
  for (const Warning& warning : apparent_joints(resolve(model)))
    out.push_back(warning.code + ": " + warning.detail);
  return out;
}

std::vector<std::string> codes(const Model& model) {
  std::vector<std::string> out;
  for (const Warning& warning : apparent_joints(resolve(model))) out.push_back(warning.code);
  return out;
}

using Texts = std::vector<std::string>;

/// A column that stands on a beam in the drawing.
Model tee(double miss) {
  return model_of(
      {{"a", 0.0, 0.0}, {"b", 8.0, 6.0}, {"foot", 4.0 - 0.6 * miss, 3.0 + 0.8 * miss}, {"top", 4.0, 8.0}},
      {member("beam", "a", "b"), member("column", "foot", "top")});
}

TEST(ApparentJoints, NodeOnAMemberIsTold) {
  const Texts expected = {
      "tee_unjoined: nodes lie on members that they are not joined to: node \"foot\" on member \"beam\" at "
      "0.5 of "
      "its length; to join them, divide the member at the node"};
  EXPECT_EQ(texts(tee(0.0)), expected);
  EXPECT_EQ(texts(tee(0.9e-3 * 5.0)), expected);  // the column has a length of about 5
  EXPECT_EQ(texts(tee(1.1e-3 * 5.0)), Texts{});
}

TEST(ApparentJoints, DividedMembersAreJoined) {
  EXPECT_EQ(codes(model_of({{"a", 0.0, 0.0}, {"b", 8.0, 6.0}, {"foot", 4.0, 3.0}, {"top", 4.0, 8.0}},
                           {member("left", "a", "foot"), member("right", "foot", "b"),
                            member("column", "foot", "top")})),
            Texts{});
}

/// Two members that cross without a node do not touch in the drawing of their nodes: no joint is claimed.
TEST(ApparentJoints, CrossingMembersAreNotTold) {
  EXPECT_EQ(codes(model_of({{"a", 0.0, 0.0}, {"b", 1.0, 1.0}, {"c", 0.0, 1.0}, {"d", 1.0, 0.0}},
                           {member("up", "a", "b"), member("down", "c", "d")})),
            Texts{});
}

TEST(ApparentJoints, ASpringJoinsANodeToAMember) {
  Model model = tee(0.0);
  Spring spring;
  spring.id = "bolt";
  spring.at.node = "foot";
  spring.stiffness = 1.0;
  spring.direction = {0.0, 1.0};
  model.springs = {spring};
  EXPECT_EQ(codes(model), Texts{"tee_unjoined"});  // to the ground
  model.springs[0].to = Location{"", "beam", 0.5};
  EXPECT_EQ(codes(model), Texts{});
  model.springs[0].at = Location{"", "beam", 0.5};
  model.springs[0].to = Location{"foot", "", 0.0};
  EXPECT_EQ(codes(model), Texts{});
  model.springs[0].to = Location{"top", "", 0.0};
  EXPECT_EQ(codes(model), Texts{"tee_unjoined"});
}

/// Points of each curve by its own formula, on it and off it to both sides.
TEST(ApparentJoints, NodesOnCurvesAreTold) {
  struct Case {
    Curve curve;
    double x, y;    ///< on the curve from (0, 0) to (10, 0)
    double nx, ny;  ///< a direction across it
  };
  const double third = std::numbers::pi / 3.0;
  const double radius = 5.0;                  // half circle below the chord for a turn to the left
  const double wide = 10.0 / std::sqrt(2.0);  // radius 5 sqrt 2, turn of 270 degrees, centre (5, -5) below
  const Case cases[] = {{ParabolaCurve{2.0, {}}, 2.5, 1.5, 0.0, 1.0},
                        {ParabolaCurve{2.0, std::array<double, 2>{0.0, -1.0}}, 2.5, -1.5, 0.0, 1.0},
                        {SineCurve{1.0, 4}, 1.25, 1.0, 0.0, 1.0},
                        {SineCurve{1.0, 4}, 3.75, -1.0, 0.0, 1.0},
                        {ArcCurve{180.0}, 5.0 + radius * std::cos(third), -radius * std::sin(third),
                         std::cos(third), -std::sin(third)},
                        {ArcCurve{-270.0}, 5.0 + wide * std::cos(0.7), 5.0 + wide * std::sin(0.7),
                         std::cos(0.7), std::sin(0.7)},
                        {PointsCurve{{{3.0, 4.0}, {6.0, -1.0}, {8.0, 3.0}}}, 6.0, -1.0, 0.0, 1.0}};
  for (const Case& one : cases) {
    for (const double miss : {0.0, 0.9e-3, -0.9e-3, 3e-3, -3e-3}) {
      const double x = one.x + miss * one.nx;
      const double y = one.y + miss * one.ny;
      const Model model = model_of({{"a", 0.0, 0.0}, {"b", 10.0, 0.0}, {"c", x, y}, {"d", x, y + 1.0}},
                                   {member("curve", "a", "b", one.curve), member("post", "c", "d")});
      EXPECT_EQ(codes(model), std::abs(miss) < 1e-3 ? Texts{"tee_unjoined"} : Texts{})
          << "curve " << one.curve.index() << " at (" << x << ", " << y << ")";
    }
  }
}

TEST(ApparentJoints, MembersOnOneAnotherAreTold) {
  const std::vector<Node> nodes = {{"a", 1.0, 2.0}, {"b", 4.0, 6.0}};
  const PointsCurve spline{{{2.0, 3.5}, {3.0, 4.0}}};
  const PointsCurve reversed{{{3.0, 4.0}, {2.0, 3.5}}};
  struct Case {
    Curve one, back;  ///< the same axis from a to b, and from b to a
    Curve other;
  };
  const Case cases[] = {{LineCurve{}, LineCurve{}, ArcCurve{1.0}},
                        {ArcCurve{70.0}, ArcCurve{-70.0}, ArcCurve{70.001}},
                        {ParabolaCurve{0.3, {}}, ParabolaCurve{-0.3, {}}, ParabolaCurve{-0.30001, {}}},
                        {SineCurve{0.3, 2}, SineCurve{0.3, 2}, SineCurve{-0.3, 2}},
                        {SineCurve{0.3, 3}, SineCurve{-0.3, 3}, SineCurve{0.3, 1}},
                        {spline, reversed, PointsCurve{{{2.0, 3.5}, {3.0, 4.001}}}}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.one.index());
    const auto with = [&](const Member& second) {
      return model_of(nodes, {member("p", "a", "b", one.one), second});
    };
    EXPECT_EQ(codes(with(member("q", "a", "b", one.one))), Texts{"stacked_members"});
    EXPECT_EQ(codes(with(member("q", "b", "a", one.back))), Texts{"stacked_members"});
    EXPECT_EQ(codes(with(member("q", "a", "b", one.other))), Texts{});
  }
  EXPECT_EQ(
      texts(model_of(nodes, {member("p", "a", "b"), member("q", "b", "a"), member("r", "a", "b")})),
      Texts{
          "stacked_members: members lie on one another: member \"q\" on member \"p\", member \"r\" on member "
          "\"p\"; they act side by side, each with its section"});
}

Model gap(double distance) {
  return model_of({{"a", 0.0, 0.0}, {"b", 5.0, 0.0}, {"c", 5.0 + distance, 0.0}, {"d", 5.0 + distance, 3.0}},
                  {member("beam", "a", "b"), member("column", "c", "d")});
}

TEST(ApparentJoints, EndsInAlmostOnePlaceAreTold) {
  for (const double distance : {0.0, 2.9e-3})
    EXPECT_EQ(codes(gap(distance)), Texts{"near_nodes"}) << distance;
  EXPECT_EQ(codes(gap(3.1e-3)), Texts{});
  EXPECT_EQ(
      texts(gap(2e-3)),
      Texts{"near_nodes: nodes lie in almost one place and are not joined: node \"b\" and node \"c\" at a "
            "distance of 0.002; to join members, let them end at one node"});
}

TEST(ApparentJoints, NodesThatSpringsMembersOrSupportsKeepTogetherAreNotTold) {
  Model spring = gap(0.0);
  spring.springs.emplace_back();
  spring.springs[0].id = "hinge";
  spring.springs[0].at = Location{"", "beam", 1.0};
  spring.springs[0].to = Location{"c", "", 0.0};
  EXPECT_EQ(codes(spring), Texts{});
  Model link = gap(2e-3);
  link.members.push_back(member("link", "c", "b"));
  EXPECT_EQ(codes(link), Texts{});
  Model held = gap(0.0);
  held.supports.resize(2);
  held.supports[0] = {"b", true, true, false, 0.0, {}};
  held.supports[1] = {"c", true, false, false, 0.0, {}};
  EXPECT_EQ(codes(held), Texts{"near_nodes"});
  held.supports[1].y = true;
  EXPECT_EQ(codes(held), Texts{});
}

/// Many places are counted, and three of them named.
TEST(ApparentJoints, NameThreePlacesAndCountTheOthers) {
  std::vector<Node> nodes = {{"a", 0.0, 0.0}, {"b", 10.0, 0.0}};
  std::vector<Member> members = {member("beam", "a", "b")};
  for (int i = 1; i <= 9; ++i) {
    const std::string id = std::to_string(i);
    nodes.push_back({"foot" + id, static_cast<double>(i), 0.0});
    nodes.push_back({"top" + id, static_cast<double>(i), 1.0});
    members.push_back(member("post" + id, "foot" + id, "top" + id));
  }
  const Texts found = texts(model_of(nodes, members));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("at 0.3 of its length and 6 more; "), std::string::npos) << found[0];
}

}  // namespace
}  // namespace snapthrough
