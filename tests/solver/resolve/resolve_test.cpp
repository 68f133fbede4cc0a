/// Indices for the ids of a model.
#include <gtest/gtest.h>

#include <variant>

#include "solver/resolve/resolved_model.h"

namespace snapthrough {
namespace {

/// A chain of two members, listed against the order of their nodes, with one object of each kind that refers
/// to another.
Model with_references() {
  Model model;
  model.nodes = {{"c", 2.0, 0.0}, {"b", 1.0, 0.0}, {"a", 0.0, 0.0}};
  model.sections = {{"stiff", 2e6, 2.0, {}}, {"soft", 1e6, 1.0, {}}};
  model.members = {{"second", "b", "c", "soft", LineCurve{}}, {"first", "a", "b", "stiff", LineCurve{}}};
  model.supports = {{"a", true, true, true, 0.0, {}}};
  Spring link;
  link.at.node = "b";
  link.to = Location{"c", "", 0.0};
  Spring on_member;
  on_member.at = {"", "first", 0.25};
  model.springs = {link, on_member};
  Foundation base;
  base.member = "first";
  base.stiffness = 7.0;
  model.foundations = {base};
  model.loads = {PointLoad{{"c", "", 0.0}, {1.0, 2.0}},
                 DistributedLoad{"first", {0.0, -1.0}},
                 PressureLoad{"second", 3.0},
                 InitialStrain{"first", 1e-3},
                 SelfWeight{{0.0, -9.81}},
                 TemperatureLoad{"second", 20.0}};
  model.imperfections = {SineImperfection{"first", 1, 0.01}, PointsImperfection{"second", {{0.5, 0.01}}}};
  model.masses = {{{"", "second", 0.5}, 4.0}};
  model.monitors = {{"u", {"c", "", 0.0}, Component::x}};
  return model;
}

TEST(Resolve, FindsWhatEachFieldNames) {
  Model given = with_references();
  given.loads.clear();
  const ResolvedModel model = resolve(given);
  EXPECT_EQ(model.members[0].start, 1);
  EXPECT_EQ(model.members[0].end, 0);
  EXPECT_EQ(model.members[0].section, 1);
  EXPECT_EQ(model.start_of(model.members[1]).id, "a");
  EXPECT_EQ(model.end_of(model.members[1]).id, "b");
  EXPECT_EQ(model.section_of(model.members[1]).id, "stiff");
  EXPECT_EQ(model.supports[0].node, 2);
  EXPECT_EQ(model.springs[0].at, (ResolvedLocation{1, -1, 0.0}));
  EXPECT_EQ(model.springs[0].to, (ResolvedLocation{0, -1, 0.0}));
  EXPECT_EQ(model.springs[1].at, (ResolvedLocation{-1, 1, 0.25}));
  EXPECT_TRUE(model.springs[1].at.is_on_member());
  EXPECT_EQ(model.springs[1].to, std::nullopt);
  EXPECT_EQ(model.foundations[0].member, 1);
  EXPECT_EQ(model.foundations[0].stiffness, 7.0);
  EXPECT_EQ(model.masses[0].at, (ResolvedLocation{-1, 0, 0.5}));
  EXPECT_EQ(model.masses[0].mass, 4.0);
  EXPECT_EQ(model.monitors[0].at.node, 0);
}

TEST(Resolve, MakesBasicActionsOfLoadsInTheirOrder) {
  Model given = with_references();
  for (Section& section : given.sections) {
    section.mass = section.id == "stiff" ? 3.0 : 2.0;
    section.expansion = 1e-5;
  }
  const ResolvedModel model = resolve(given);
  ASSERT_EQ(model.actions.size(), 7U);  // a weight for each of two members
  EXPECT_EQ(std::get<PointAction>(model.actions[0].what).at.node, 0);
  EXPECT_EQ(std::get<PointAction>(model.actions[0].what).force[1], 2.0);
  const auto& line = std::get<LineAction>(model.actions[1].what);
  EXPECT_EQ(line.member, 1);
  ASSERT_EQ(line.pieces.size(), 1U);
  EXPECT_EQ(line.pieces[0].at(0.3)[1], -1.0);
  EXPECT_EQ(std::get<PressureAction>(model.actions[2].what).member, 0);
  EXPECT_EQ(std::get<StrainAction>(model.actions[3].what).axial, 1e-3);
  for (const std::size_t member : {0U, 1U}) {
    const auto& weight = std::get<LineAction>(model.actions[4 + member].what);
    EXPECT_EQ(weight.member, static_cast<int>(member));
    EXPECT_EQ(weight.pieces[0].at(0.5)[1],
              *model.section_of(model.members[member]).mass == AlongMember(3.0) ? -9.81 * 3.0 : -9.81 * 2.0);
    EXPECT_EQ(model.actions[4 + member].load, 4);
  }
  EXPECT_EQ(std::get<StrainAction>(model.actions[6].what).axial, 20.0 * 1e-5);
  EXPECT_EQ(model.actions[6].name, "the temperature of member \"second\"");
  EXPECT_EQ(model.actions_on_member, (std::vector<std::vector<int>>{{2, 4, 6}, {1, 3, 5}}));
}

/// Pieces of a force that is given along a member end where the force bends inside its range, and nowhere
/// else.
TEST(Resolve, DividesLineActionsWhereTheirForceBends) {
  Model given = with_references();
  DistributedLoad load{"first", {0.0, 0.0}, {0.2, 0.6}};
  load.force_along = {{0.0, {0.0, 0.0}}, {0.4, {0.0, 4.0}}, {0.8, {0.0, 4.0}}};
  given.loads = {load};
  const ResolvedModel model = resolve(given);
  const auto& line = std::get<LineAction>(model.actions[0].what);
  ASSERT_EQ(line.pieces.size(), 2U);
  EXPECT_EQ(line.pieces[0].range, (std::array{0.2, 0.4}));
  EXPECT_EQ(line.pieces[0].from[1], 2.0);
  EXPECT_EQ(line.pieces[0].to[1], 4.0);
  EXPECT_EQ(line.pieces[1].range, (std::array{0.4, 0.6}));
  EXPECT_EQ(line.pieces[1].at(0.5)[1], 4.0);
}

TEST(Resolve, FindsTheMembersOfImperfections) {
  Model given = with_references();
  given.loads.clear();
  const ResolvedModel model = resolve(given);
  ASSERT_EQ(model.imperfections.size(), 2U);
  EXPECT_EQ(std::get<ResolvedSineImperfection>(model.imperfections[0]).member, 1);
  EXPECT_EQ(std::get<ResolvedPointsImperfection>(model.imperfections[1]).member, 0);
}

TEST(Resolve, TakesOneSidedMembersForSprings) {
  Model given = with_references();
  given.members[0].reaction = Reaction::tension_only;  // "second"; nothing below refers to it
  given.loads = {PointLoad{{"c", "", 0.0}, {1.0, 2.0}}};
  given.imperfections = {SineImperfection{"first", 1, 0.01}};
  given.masses.clear();
  const ResolvedModel model = resolve(given);
  ASSERT_EQ(model.members.size(), 1U);
  EXPECT_EQ(model.foundations[0].member, 0);
  EXPECT_EQ(std::get<ResolvedSineImperfection>(model.imperfections[0]).member, 0);
  ASSERT_EQ(model.springs.size(), 3U);
  EXPECT_EQ(model.springs[2].at.node, 1);
  EXPECT_EQ(model.springs[2].to, (ResolvedLocation{0, -1, 0.0}));
  EXPECT_EQ(model.springs[2].rod, 0U);
}

}  // namespace
}  // namespace snapthrough
