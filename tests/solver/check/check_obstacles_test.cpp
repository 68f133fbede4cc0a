/// Supports that hold a node inside a rigid foundation.
#include <gtest/gtest.h>

#include <limits>

#include "solver/check/check.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// The end of a beam is pushed 10 mm into a rigid bed: its moments depended on the mesh.
TEST(Obstacles, SupportInsideARigidFoundationIsRefused) {
  Model model = straight(6.0, 3000.0, 2e6, "xy", "y");
  model.foundations = {one_sided("m", std::numeric_limits<double>::infinity(), Side::right)};
  DistributedLoad load;
  load.member = "m";
  load.force = {0.0, -5.0};
  model.loads = {load};
  const auto findings_with = [&](double y, double gap, double factor) {
    model.supports[1].displacement = PrescribedDisplacement{0.0, y, 0.0, Pattern::proportional};
    model.foundations[0].gap = gap;
    return check(model, static_on({}, Geometry::nonlinear, {factor}));
  };
  const auto findings = findings_with(-0.01, 0.0, 1.0);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].pointer, "/model/supports/1/displacement");
  EXPECT_EQ(findings[0].code, "enters_obstacle");
  EXPECT_TRUE(findings_with(0.01, 0.0, 1.0).empty());
  EXPECT_TRUE(findings_with(-0.01, 0.02, 1.0).empty());
  EXPECT_FALSE(findings_with(-0.01, 0.02, 3.0).empty());
}

/// A support slides along the wall of a circular hole: the wall turns away by the square of the displacement,
/// which small displacements leave out.
TEST(Obstacles, SmallDisplacementsSlideAlongAnOutline) {
  Model model = straight(2.0, 1.0, 1e3, "xy", "xy");
  Foundation wall = one_sided("m", std::numeric_limits<double>::infinity(), Side::right);
  wall.outline = CircleOutline{{1.0, 0.0}, 1.0, false};
  model.foundations = {wall};
  model.supports[1].displacement = PrescribedDisplacement{0.0, 0.01, 0.0, Pattern::proportional};
  EXPECT_TRUE(check(model, static_on({}, Geometry::linear, {1.0})).empty());
  EXPECT_EQ(check(model, static_on({}, Geometry::nonlinear, {1.0})).size(), 1U);
}

}  // namespace
}  // namespace snapthrough
