/// Tangent stiffness of places of a structure, against closed forms.
#include <limits>

#include "tests/findings.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

Result solved(const Model& model, Geometry geometry, const std::vector<Location>& places,
              std::vector<double> factors = {1.0}) {
  Analysis analysis = static_on(accurate(1e-10), geometry, std::move(factors));
  analysis.output.stiffness_at = places;
  return solve_soundly(model, analysis);
}

/// Cantilever along x: its tip has the flexibilities L / EA, L^3 / 3 EI, L^2 / 2 EI and L / EI.
TEST(PlaceStiffness, TipOfACantilever) {
  constexpr double L = 2.0;
  constexpr double EI = 6.0;
  constexpr double EA = 50.0;
  Model model = straight(L, EI, EA, "xyr", "");
  model.loads = {force_at(at_node("b"), 0.0, 1e-3)};
  const Result result = solved(model, Geometry::linear, {at_node("b"), at_member("m", 0.5), at_node("a")});
  const auto& places = result.states.at(0).stiffness_at;
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[0].node, "b");
  EXPECT_FALSE(places[0].member);
  ASSERT_TRUE(places[0].tangent);
  const auto& tip = *places[0].tangent;
  EXPECT_NEAR(tip[0][0], EA / L, 1e-9);
  EXPECT_NEAR(tip[1][1], 12.0 * EI / std::pow(L, 3), 1e-9);
  EXPECT_NEAR(tip[2][2], 4.0 * EI / L, 1e-9);
  EXPECT_NEAR(tip[1][2], -6.0 * EI / (L * L), 1e-9);
  EXPECT_NEAR(tip[2][1], tip[1][2], 1e-9);
  EXPECT_NEAR(tip[0][1], 0.0, 1e-9);
  // half way, the part beyond is free and adds nothing
  EXPECT_EQ(places[1].member, "m");
  EXPECT_EQ(places[1].fraction, 0.5);
  ASSERT_TRUE(places[1].tangent);
  EXPECT_NEAR((*places[1].tangent)[1][1], 12.0 * EI / std::pow(0.5 * L, 3), 1e-8);
  EXPECT_FALSE(places[2].tangent) << "a clamped place has no finite stiffness";
}

/// Under the axial force P, k^2 = P / EI, the tip of an inextensible cantilever has the lateral flexibility
/// (tan(k L) / k - L) / P: its stiffness vanishes at Euler's load.
TEST(PlaceStiffness, FallsWithTheLoad) {
  constexpr double L = 2.0;
  constexpr double EI = 6.0;
  Model model = straight(L, EI, std::numeric_limits<double>::infinity(), "xyr", "");
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  const double euler = kPi * kPi * EI / (4.0 * L * L);
  for (const double share : {0.2, 0.7, 0.99}) {
    const double P = share * euler;
    const double k = std::sqrt(P / EI);
    const Result result = solved(model, Geometry::nonlinear, {at_node("b")}, {P});
    const auto& tip = result.states.at(0).stiffness_at.at(0).tangent;
    ASSERT_FALSE(tip) << "inextensible: the tip cannot move along x in the first order";
    Model stretched = model;
    stretched.sections[0].EA = 1e9;
    const Result other = solved(stretched, Geometry::nonlinear, {at_node("b")}, {P});
    const auto& matrix = other.states.at(0).stiffness_at.at(0).tangent;
    ASSERT_TRUE(matrix);
    // stiffness against a lateral displacement whose rotation is free
    const auto& m = *matrix;
    const double lateral = m[1][1] - m[1][2] * m[2][1] / m[2][2];
    EXPECT_NEAR(lateral, P / (std::tan(k * L) / k - L), 1e-6 * EI / std::pow(L, 3)) << share;
  }
}

TEST(PlaceStiffness, PlacesAreChecked) {
  Model model = straight(1.0, 1.0, 1e3, "xyr", "");
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  Analysis analysis = static_on(fixed_mesh(1, 4), Geometry::linear);
  analysis.output.stiffness_at = {at_node("nowhere")};
  EXPECT_THAT(check(model, analysis),
              ::testing::Contains(is_finding("/analysis/output/stiffness_at/0/node", "unknown_reference")));
  Analysis buckling = buckling_on(fixed_mesh(1, 4));
  buckling.output.stiffness_at = {at_node("b")};
  EXPECT_THAT(check(model, buckling),
              ::testing::Contains(is_finding("/analysis/output/stiffness_at", "unsupported")));
}

}  // namespace
}  // namespace snapthrough
