/// How a model is read as a straight column, piece by piece, and what is left to the elements.
#include "solver/column/column_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "solver/column/column_frame.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

/// Two members of lengths 2 and 4 along the x axis, the second drawn from its far end; EI 6 and 3. Held at a,
/// guided at c, with everything on it that a column may have.
Model two_members() {
  Model model;
  model.nodes = {{"a", 1.0, 2.0}, {"b", 3.0, 2.0}, {"c", 7.0, 2.0}};
  model.sections = {{"stiff", 500.0, 6.0, {}}, {"soft", 100.0, 3.0, {}}};
  model.members = {{"left", "a", "b", "stiff", LineCurve{}, false, false},
                   {"right", "c", "b", "soft", LineCurve{}, false, false}};
  model.supports = {{"a", true, true, true, 0.0, {}}, {"c", false, true, false, 0.0, {}}};
  model.springs = {{"lateral", {"b", "", 0.0}, std::array{0.0, -2.0}, 5.0, Reaction::bilateral, 0.0},
                   {"turning", {"", "right", 0.25}, {}, 7.0, Reaction::bilateral, 0.0}};
  Foundation base{"base", "right", 8.0, 0.5, Reaction::bilateral, Side::left, {0.5, 1.0}, 0.0, {}};
  model.foundations = {base};
  model.loads = {PointLoad{{"c", "", 0.0}, {-10.0, 0.0}, 0.0, Pattern::proportional},
                 PointLoad{{"", "left", 0.5}, {-3.0, 0.0}, 0.0, Pattern::constant}};
  return model;
}

/// Lengths over 4, stiffnesses over 6, forces over 6 / 16, lateral springs over 6 / 64, bases over 6 / 256,
/// turning springs over 6 / 4.
TEST(ColumnLine, IsReadFromOneEndToTheOther) {
  const auto line = column_line(resolve(two_members()));
  ASSERT_TRUE(line);
  EXPECT_DOUBLE_EQ(line->length, 4.0);
  EXPECT_DOUBLE_EQ(line->stiffness, 6.0);
  EXPECT_DOUBLE_EQ(std::abs(line->normal[1]), 1.0);
  // cut at the constant load, at b, where the base ends, and at the turning spring
  ASSERT_EQ(line->spans.size(), 5U);
  const double lengths[] = {0.25, 0.25, 0.5, 0.25, 0.25};
  const double compression[] = {10.0, 10.0, 10.0, 10.0, 10.0};
  const double constant[] = {3.0, 0.0, 0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 5; ++i) {
    SCOPED_TRACE(i);
    const ColumnSpan& span = line->spans[i];
    EXPECT_NEAR(span.length, lengths[i], 1e-15);
    EXPECT_DOUBLE_EQ(span.EI, i < 2 ? 1.0 : 0.5);
    EXPECT_EQ(span.member, i < 2 ? 0 : 1);
    EXPECT_NEAR(span.proportional, compression[i] * 16.0 / 6.0, 1e-13);
    EXPECT_NEAR(span.constant, constant[i] * 16.0 / 6.0, 1e-13);
    EXPECT_NEAR(span.foundation, i == 2 ? 8.0 * 256.0 / 6.0 : 0.0, 1e-12);
    EXPECT_NEAR(span.layer, i == 2 ? 0.5 * 16.0 / 6.0 : 0.0, 1e-13);
  }
  // the second member runs backwards
  EXPECT_DOUBLE_EQ(line->spans[2].fractions[0], 1.0);
  EXPECT_DOUBLE_EQ(line->spans[2].fractions[1], 0.5);
  ASSERT_EQ(line->joints.size(), 6U);
  EXPECT_TRUE(line->joints[0].held);
  EXPECT_TRUE(line->joints[0].right.held);
  EXPECT_NEAR(line->joints[2].spring, 5.0 * 64.0 / 6.0, 1e-12);
  EXPECT_NEAR(line->joints[4].left.spring + line->joints[4].right.spring, 7.0 * 4.0 / 6.0, 1e-13);
  EXPECT_TRUE(line->joints[5].held);
  EXPECT_FALSE(line->joints[5].left.held);
  for (const ColumnJoint& joint : line->joints) EXPECT_FALSE(joint.hinge);
}

TEST(ColumnLine, FromTheOtherEndIsTheSameColumn) {
  const auto line = column_line(resolve(two_members()));
  ASSERT_TRUE(line);
  const ColumnLine back = reversed(*line);
  EXPECT_DOUBLE_EQ(back.spans.front().length, line->spans.back().length);
  EXPECT_DOUBLE_EQ(back.spans.front().fractions[0], line->spans.back().fractions[1]);
  EXPECT_TRUE(back.joints.back().left.held) << "the clamped end's rotation is held on its inner side";
  for (const double lambda : {0.01, 0.1, 1.0, 3.0, 10.0})
    EXPECT_EQ(count_below(back, lambda).negative, count_below(*line, lambda).negative) << lambda;
}

/// A hinge belongs to the member that is released; the other one turns with what holds the node.
TEST(ColumnLine, KnowsWhichSideOfAHingeIsHeld) {
  Model model = two_members();
  model.members[1].release_end_rotation = true;  // at b: the second member ends there
  model.springs.push_back({"node", {"b", "", 0.0}, {}, 1.5, Reaction::bilateral, 0.0});
  const auto line = column_line(resolve(model));
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->joints[2].hinge);
  EXPECT_DOUBLE_EQ(line->joints[2].left.spring, 1.5 * 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(line->joints[2].right.spring, 0.0);
}

/// Held at both ends the force between follows from the lengths: 10 at a third of equal stiffness leaves 20/3
/// on the near side in compression and 10/3 on the far side in tension.
TEST(ColumnLine, SharesForcesBetweenHeldEnds) {
  Model model = testing::column(3.0, 1.0, 100.0, 0.0);
  model.supports[1].x = true;
  model.loads = {PointLoad{{"", "column", 1.0 / 3.0}, {-10.0, 0.0}, 0.0, Pattern::proportional}};
  const auto line = column_line(resolve(model));
  ASSERT_TRUE(line);
  ASSERT_EQ(line->spans.size(), 2U);
  EXPECT_NEAR(line->spans[0].proportional, 20.0 / 3.0 * 9.0, 1e-12);
  EXPECT_NEAR(line->spans[1].proportional, -10.0 / 3.0 * 9.0, 1e-12);
  // warming by 1e-3 on top, at constant strain: EA times it everywhere
  model.loads.push_back(InitialStrain{"column", 1e-3, 0.0, Pattern::constant});
  const auto warm = column_line(resolve(model));
  ASSERT_TRUE(warm);
  for (const ColumnSpan& span : warm->spans) EXPECT_NEAR(span.constant, 0.1 * 9.0, 1e-13);
}

/// One change to the column makes it none.
struct Other {
  std::string name;
  std::function<void(Model&)> change;
};

class NoColumn : public ::testing::TestWithParam<Other> {};

TEST_P(NoColumn, IsLeftToTheElements) {
  Model model = two_members();
  GetParam().change(model);
  EXPECT_FALSE(column_line(resolve(model)));
}

INSTANTIATE_TEST_SUITE_P(
    Because, NoColumn,
    ::testing::Values(
        Other{"AMemberIsCurved", [](Model& m) { m.members[0].curve = ArcCurve{10.0}; }},
        Other{"TheSectionShears", [](Model& m) { m.sections[1].GA = 50.0; }},
        Other{"TheLineBends", [](Model& m) { m.nodes[2].y += 1e-9; }},
        Other{"TheLineTurnsBack", [](Model& m) { m.nodes[2].x = 0.0; }},
        Other{"ItForks",
              [](Model& m) {
                m.nodes.push_back({"d", 3.0, 9.0});
                m.members.push_back({"third", "b", "d", "soft", LineCurve{}, false, false});
              }},
        Other{"AnAxisIsImperfect",
              [](Model& m) {
                m.imperfections = {SineImperfection{"left", 1, 1e-6}};
              }},
        Other{"ASpringActsOnOneSide", [](Model& m) { m.springs[0].reaction = Reaction::compression_only; }},
        Other{"ABaseActsOnOneSide", [](Model& m) { m.foundations[0].reaction = Reaction::tension_only; }},
        Other{"ABaseIsInclined",
              [](Model& m) {
                m.foundations[0].direction = std::array{0.1, 1.0};
              }},
        Other{"ASpringIsInclined",
              [](Model& m) {
                m.springs[0].direction = std::array{0.1, 1.0};
              }},
        Other{"ASupportIsInclined", [](Model& m) { m.supports[1].angle_degrees = 20.0; }},
        Other{"ASupportIsMovedAcross",
              [](Model& m) {
                m.supports[1].displacement = PrescribedDisplacement{0.0, 0.1, 0.0, {}};
              }},
        Other{"ASupportIsTurned",
              [](Model& m) {
                m.supports[0].displacement = PrescribedDisplacement{0.0, 0.0, 0.1, {}};
              }},
        Other{"ALoadActsAcross",
              [](Model& m) {
                std::get<PointLoad>(m.loads[0]).force = {-10.0, 1e-6};
              }},
        Other{"ALoadTurns", [](Model& m) { std::get<PointLoad>(m.loads[0]).moment = 1e-6; }},
        Other{"ALoadIsDistributed",
              [](Model& m) {
                m.loads.push_back(DistributedLoad{"left", {-1.0, 0.0}, {0.0, 1.0}, LoadMeasure::length, {}});
              }},
        Other{"ALoadFollows",
              [](Model& m) {
                m.loads.push_back(PressureLoad{"left", 1.0, Side::left, {}});
              }},
        Other{"AStrainBends",
              [](Model& m) {
                m.loads.push_back(InitialStrain{"left", 0.0, 0.1, {}});
              }},
        Other{"NothingHoldsItAlong", [](Model& m) { m.supports[0] = {"a", false, true, true, 0.0, {}}; }},
        Other{"ASpringSharesTheForce",
              [](Model& m) {
                m.springs.push_back({"along", {"c", "", 0.0}, std::array{1.0, 0.0}, 4.0, {}, 0.0});
              }}),
    [](const auto& p) { return p.param.name; });

/// Counts of a pinned column: n below load factors between (n pi)^2 and ((n + 1) pi)^2; the determinant
/// changes its sign at each.
TEST(ColumnFrame, CountsEulersLoads) {
  const auto line = column_line(resolve(testing::column(1.0, 1.0, 1e6, 0.0)));
  ASSERT_TRUE(line);
  constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
  for (int n = 0; n < 12; ++n) {
    for (const double share : {0.01, 0.5, 0.99}) {
      const double lambda = kPi2 * (n * n + share * (2 * n + 1));
      const ColumnCount at = count_below(*line, lambda);
      EXPECT_EQ(at.negative, n) << lambda;
      EXPECT_EQ(at.determinant.mantissa > 0.0,
                (count_below(*line, 0.0).determinant.mantissa > 0.0) == (n % 2 == 0))
          << lambda;
      EXPECT_EQ(count_below(*line, lambda, true).negative, n) << "cut finer";
    }
  }
}

TEST(ColumnFrame, StopsWhenAskedTo) {
  auto line = column_line(resolve(testing::column(1.0, 1.0, 1e6, 0.0)));
  ASSERT_TRUE(line);
  std::stop_source stop;
  line->stop = stop.get_token();
  EXPECT_EQ(count_below(*line, 20.0).negative, 1);
  stop.request_stop();
  EXPECT_ANY_THROW((void)count_below(*line, 20.0));
}

}  // namespace
}  // namespace snapthrough
