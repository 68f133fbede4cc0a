/// Linearised buckling of members whose axial force friction along them carries.
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// A pinned pile of length 20 in ground of stiffness 20, with friction of 10 per length that slips at 0.001.
Model pile(double load) {
  Model model = straight(20.0, 500.0, 1e6, "xy", "y");
  Foundation friction;
  friction.id = "tz";
  friction.member = "m";
  friction.component = FoundationComponent::tangent;
  friction.law = ReactionLaw{};
  friction.law->type = ReactionLaw::Type::table;
  friction.law->points = {{0.001, 10.0}};
  model.foundations = {winkler("m", 20.0), friction};
  model.loads = {force_at(at_node("b"), -load, 0.0)};
  return model;
}

/// Expected: 60 sine terms with the axial forces of N' = min(1e4 u, 10), u' = N / EA buckle under P =
/// 258.53077. That is the load factor one of the pile under this load. The beam also shortens, by P / EA
/// = 2.6e-4.
TEST(BucklingWithFriction, TakesTheStressesOfTheStateUnderTheReferenceLoad) {
  const Result result = solve_soundly(pile(258.53077), buckling_on(accurate(1e-4)));
  ASSERT_TRUE(result.summary.critical_load_factor);
  expect_relative(*result.summary.critical_load_factor, 1.0, 3e-4, "load factor");
  EXPECT_TRUE(result.warnings.empty());
}

/// Under less load friction has another share of it, which the load factor does not know.
TEST(BucklingWithFriction, WarnsWhereTheStressesDoNotGrowInProportion) {
  const Result result = solve(pile(150.0), buckling_on(accurate(1e-4)));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].code, "laws_change");
}

}  // namespace
}  // namespace snapthrough
