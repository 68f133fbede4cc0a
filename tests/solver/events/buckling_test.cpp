/// Linearised buckling by inertia counts and inverse iteration, on columns whose loads are closed forms.
#include "solver/events/buckling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/discrete/build_structure.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
/// Elements of order 6, at least six a half wave: h^12 of the half wave's sixth.
constexpr double kMesh = 1e-8;

struct Buckled {
  LinearBuckling at;
  double unit = 1.0;  ///< scaled load factor by load factor of the model
};

Buckled buckle(const Model& model, int count) {
  const Structure structure = make_structure(resolve(model), testing::fixed_mesh(24, 6), Geometry::nonlinear);
  StructuralProblem problem(structure);
  return {linear_buckling(structure, problem, count, structure.scales.load), structure.scales.load};
}

TEST(LinearBuckling, HasEulersLoadsInOrder) {
  const Buckled found = buckle(testing::column(2.0, 3.0, 1e8, 0.0), 4);
  ASSERT_EQ(found.at.loads.size(), 4U);
  ASSERT_EQ(found.at.modes.size(), 4U);
  EXPECT_EQ(found.at.negative_at_start, 0);
  for (int n = 1; n <= 4; ++n) {
    // the column shortens before it buckles: 1e8 makes it some 1e-6 of the load
    EXPECT_NEAR(found.at.loads[static_cast<std::size_t>(n - 1)] / found.unit, n * n * kPi2 * 3.0 / 4.0,
                1e-5 * n * n * kPi2);
    EXPECT_FALSE(found.at.modes[static_cast<std::size_t>(n - 1)].isZero(1e-3));
  }
}

/// On a base of 4 pi^4 one and two half waves buckle at one load, 5 pi^2: it counts twice, and has two modes.
TEST(LinearBuckling, CountsADoubleLoadTwice) {
  const Buckled found = buckle(testing::column(1.0, 1.0, 1e10, 4.0 * kPi2 * kPi2), 3);
  ASSERT_EQ(found.at.loads.size(), 3U);
  EXPECT_NEAR(found.at.loads[0] / found.unit, 5.0 * kPi2, kMesh * 5.0 * kPi2);
  EXPECT_NEAR(found.at.loads[1] / found.unit, 5.0 * kPi2, kMesh * 5.0 * kPi2);
  EXPECT_NEAR(found.at.loads[2] / found.unit, (9.0 + 4.0 / 9.0) * kPi2, kMesh * 10.0 * kPi2);
  const Eigen::VectorXd& a = found.at.modes[0];
  const Eigen::VectorXd& b = found.at.modes[1];
  EXPECT_LT(std::abs(a.dot(b)), 0.99 * a.norm() * b.norm()) << "the same mode twice";
}

/// A constant compression of half of Euler's load leaves half of it, one of three halves one negative
/// eigenvalue and nothing below the next load.
TEST(LinearBuckling, CountsOnFromConstantActions) {
  Model model = testing::column(1.0, 1.0, 1e10, 0.0);
  model.loads.push_back(PointLoad{{"b", "", 0.0}, {-0.5 * kPi2, 0.0}, 0.0, Pattern::constant});
  const Buckled half = buckle(model, 2);
  ASSERT_EQ(half.at.loads.size(), 2U);
  EXPECT_EQ(half.at.negative_at_start, 0);
  EXPECT_NEAR(half.at.loads[0] / half.unit, 0.5 * kPi2, kMesh * kPi2);
  EXPECT_NEAR(half.at.loads[1] / half.unit, 3.5 * kPi2, kMesh * 4.0 * kPi2);
  std::get<PointLoad>(model.loads.back()).force[0] = -1.5 * kPi2;
  const Buckled more = buckle(model, 1);
  EXPECT_EQ(more.at.negative_at_start, 1);
  ASSERT_EQ(more.at.loads.size(), 1U);
  EXPECT_NEAR(more.at.loads[0] / more.unit, 2.5 * kPi2, kMesh * 4.0 * kPi2);
}

/// Where the reference load pulls, no positive factor buckles it.
TEST(LinearBuckling, HasNoLoadsInTension) {
  Model model = testing::column(1.0, 1.0, 1e6, 0.0);
  std::get<PointLoad>(model.loads[0]).force = {1.0, 0.0};
  const Buckled found = buckle(model, 2);
  EXPECT_TRUE(found.at.loads.empty());
  EXPECT_FALSE(found.at.is_mechanism);
}

/// Pulled with its shear stiffness, a column loses its resistance to shear: every mode does, n at
/// GA (1 + n^2 pi^2 EI / (GA L^2)), all within rounding here. The lowest few of them need no more than a few.
TEST(LinearBuckling, FindsSomeOfHundredsAtOneLoad) {
  constexpr double kShear = 1e10;
  Model model = testing::column(1.0, 1.0, 1e14, 0.0);
  model.sections[0].GA = kShear;
  std::get<PointLoad>(model.loads[0]).force = {1.0, 0.0};
  const Buckled found = buckle(model, 2);
  ASSERT_EQ(found.at.loads.size(), 2U);
  for (const double load : found.at.loads) EXPECT_NEAR(load / found.unit, kShear, 1e-3 * kShear);
  EXPECT_LT(found.at.factorizations, 1000);
}

/// A base that the load presses is bilateral, one that it leaves is absent: an eccentric transverse force
/// decides which. Bilateral, K = 4 pi^4 doubles to 5 pi^2; absent, Euler's load is left.
TEST(LinearBuckling, CountsAsBilateralOnlyWhatThePrestressPresses) {
  for (const double push : {1e-3, -1e-3}) {
    Model model = testing::column(1.0, 1.0, 1e8, 4.0 * kPi2 * kPi2);
    model.foundations[0].reaction = Reaction::compression_only;  // on the left: in the sense of y
    model.loads.push_back(
        DistributedLoad{"column", {0.0, push}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional});
    const Buckled found = buckle(model, 1);
    ASSERT_EQ(found.at.loads.size(), 1U);
    EXPECT_NEAR(found.at.loads[0] / found.unit, (push > 0.0 ? 5.0 : 1.0) * kPi2, 1e-4 * kPi2) << push;
    EXPECT_FALSE(found.at.touches);
  }
}

}  // namespace
}  // namespace snapthrough
