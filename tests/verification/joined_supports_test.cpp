/// One-sided supports on both sides of a structure, without gap: together they are bilateral.
///
/// Sources. Pinned column on a bilateral Winkler base: P = P_e min_n (n^2 + k / n^2), k = K L^4 / (pi^4 EI)
/// (Hetenyi 1946). A stiff lateral spring in the middle of a pinned column: with K >= 16 pi^2 EI / L^3 the
/// column buckles in two half waves, at 4 P_e (Timoshenko and Gere 1961, 2.6). Ring with bonded radial
/// springs: ring_closed_forms.csv. Loads that do not depend on a closed form are held against those of the
/// same model with bilateral supports.
#include "tests/verification/columns_between_supports.h"

namespace snapthrough {
namespace {

using namespace testing;

using Vec2 = std::array<double, 2>;

TEST(SupportsOnBothSides, BasesAreBilateralHoweverTheColumnIsDrawn) {
  for (const double K : {1.0, 100.0, 1e4}) {
    for (const double degrees : {0.0, 37.0, 90.0, 180.0, -127.0}) {
      Model model = drawn_column(degrees);
      model.foundations = {side_base("m1", K, Side::left), side_base("m1", K, Side::right)};
      expect_first_loads(model, pinned_on_bilateral(K), std::to_string(K) + " at " + std::to_string(degrees));
    }
  }
}

TEST(SupportsOnBothSides, BasesAreBilateralInPiecesAndOnSplitMembers) {
  const double K = 300.0;
  Model model = drawn_column(37.0, {0.43, 1.0});
  for (const std::string member : {"m1", "m2"}) {
    // 1/3 and 2/3 of K on overlapping ranges on the right, cut in pieces on the left
    model.foundations.push_back(side_base(member, K / 3.0, Side::right, {0.0, 1.0}));
    model.foundations.push_back(side_base(member, K, Side::left, {0.0, 0.3}));
    model.foundations.push_back(side_base(member, 2.0 * K / 3.0, Side::right, {0.0, 0.7}));
    model.foundations.push_back(side_base(member, K, Side::left, {0.3, 1.0}));
    model.foundations.push_back(side_base(member, 2.0 * K / 3.0, Side::right, {0.7, 1.0}));
  }
  expect_first_loads(model, pinned_on_bilateral(K), "pieces");
}

TEST(SupportsOnBothSides, ABaseThatPullsIsOneOnTheOtherSide) {
  Model model = drawn_column(90.0);
  Foundation pulls = side_base("m1", 100.0, Side::left);
  pulls.reaction = Reaction::tension_only;
  model.foundations = {side_base("m1", 100.0, Side::left), pulls};
  expect_first_loads(model, pinned_on_bilateral(100.0), "tension only");
}

TEST(SupportsOnBothSides, ABaseAlongADirectionOpposesOneAlongTheNormal) {
  const double angle = 37.0 * kPi / 180.0;
  Model model = drawn_column(37.0);
  Foundation along = side_base("m1", 100.0, Side::left);
  along.direction = Vec2{2.0 * std::sin(angle), -2.0 * std::cos(angle)};
  model.foundations = {side_base("m1", 100.0, Side::left), along};
  expect_first_loads(model, pinned_on_bilateral(100.0), "direction");
}

TEST(SupportsOnBothSides, SpringsHoldTheMiddle) {
  for (const double degrees : {0.0, 37.0, 90.0, 180.0}) {
    const Vec2 normal = normal_at(degrees);
    Model model = drawn_column(degrees);
    model.springs = {side_spring(at_member("m1", 0.5), normal, 1.0, 1000.0),
                     side_spring(at_member("m1", 0.5), normal, -3.0, 1000.0)};
    expect_first_loads(model, 4.0 * kPi * kPi, "at " + std::to_string(degrees));
    // at a node in one of them, in three parts on that side
    Model split = drawn_column(degrees, {0.5, 1.0});
    split.springs = {side_spring(at_node("1"), normal, 1.0, 500.0),
                     side_spring(at_member("m1", 1.0), normal, 1.0, 300.0),
                     side_spring(at_member("m2", 0.0), normal, -1.0, 200.0, Reaction::tension_only),
                     side_spring(at_node("1"), normal, -1.0, 1000.0)};
    expect_first_loads(split, 4.0 * kPi * kPi, "split, at " + std::to_string(degrees));
  }
}

/// The results tell each base by itself, and all of them are in equilibrium with the rest (solve_soundly).
TEST(SupportsOnBothSides, ABentBeamIsThatOnABilateralBase) {
  Model bilateral = drawn_column(0.0);
  bilateral.loads = {
      DistributedLoad{"m1", {0.0, -1.0}, {0.0, 0.6}, LoadMeasure::length, Pattern::proportional},
      force_at(at_member("m1", 0.8), 0.0, 2.0)};
  bilateral.monitors = {{"d", at_member("m1", 0.3), Component::y}};
  Model sides = bilateral;
  bilateral.foundations = {winkler("m1", 2e3)};
  sides.foundations = {side_base("m1", 2e3, Side::right), side_base("m1", 2e3, Side::left)};
  for (const Geometry geometry : {Geometry::linear, Geometry::nonlinear}) {
    const Result a = solve_soundly(bilateral, static_on(fixed_mesh(10, 5), geometry));
    const Result b = solve_soundly(numbered(sides), static_on(fixed_mesh(10, 5), geometry));
    expect_relative(b.static_table->monitors[0].values[0], a.static_table->monitors[0].values[0], 1e-12,
                    "deflection");
    const auto& contact = b.states[0].foundations;
    ASSERT_EQ(contact.size(), 2u);
    EXPECT_FALSE(contact[0].contact.empty());
    EXPECT_FALSE(contact[1].contact.empty());
    EXPECT_NEAR(contact[0].resultant.fy + contact[1].resultant.fy, a.states[0].foundations[0].resultant.fy,
                1e-10);
  }
}

/// Normals of a curved axis are opposite everywhere.
TEST(SupportsOnBothSides, AnArchIsThatOnABilateralBase) {
  for (const double k : {100.0, 1e4}) {
    Model bilateral = arch(20.0, 1e5, 1.0);
    add_soil(bilateral, k);
    Model sides = bilateral;
    bilateral.foundations[0].reaction = Reaction::bilateral;
    sides.foundations.push_back(side_base("arch", sides.foundations[0].stiffness, Side::right));
    const Discretization mesh = fixed_mesh(16, 5);
    expect_relative(first_load(sides, AnalysisType::critical, mesh),
                    first_load(bilateral, AnalysisType::critical, mesh), 1e-9, "k " + std::to_string(k));
  }
}

/// A gap is a gap, however small: the column buckles before it meets the bases.
TEST(SupportsOnBothSides, AGapLeavesTheColumnFree) {
  for (const double gap : {1e-12, 1e-6, 1e-3}) {
    for (const double degrees : {0.0, 90.0}) {
      Model model = drawn_column(degrees);
      model.foundations = {side_base("m1", 100.0, Side::left), side_base("m1", 100.0, Side::right)};
      for (Foundation& base : model.foundations) base.gap = gap;
      expect_relative(first_load(model, AnalysisType::critical, chosen_mesh(1e-6)), kPi * kPi, 1e-6,
                      std::to_string(gap) + " at " + std::to_string(degrees));
    }
  }
}

/// A block on springs that hold it from both sides moves nowhere freely.
TEST(SupportsOnBothSides, HoldWhatNothingElseHolds) {
  Model model = drawn_column(0.0);
  model.supports = {support("0", "x")};
  model.foundations = {side_base("m1", 100.0, Side::left), side_base("m1", 100.0, Side::right)};
  Model on_one = model;
  on_one.foundations = {winkler("m1", 100.0)};
  const Result sides = solve_soundly(numbered(model), buckling_on(fixed_mesh(12, 6), 2));
  const Result bilateral = solve_soundly(on_one, buckling_on(fixed_mesh(12, 6), 2));
  EXPECT_TRUE(sides.neutral_motion.empty());
  ASSERT_EQ(sides.buckling->load_factors.size(), 2u);
  for (int i = 0; i < 2; ++i)
    expect_relative(sides.buckling->load_factors[i], bilateral.buckling->load_factors[i], 1e-12, "mode");
}

}  // namespace
}  // namespace snapthrough
