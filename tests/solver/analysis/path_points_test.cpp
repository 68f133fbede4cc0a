/// Points evenly along a branch: of a path that is known in closed form.
#include "solver/analysis/path_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/numeric/number_text.h"
#include "solver/path/path_start.h"
#include "tests/solver/path/small_problem.h"

namespace snapthrough {
namespace {

using testing::SmallProblem;

/// Points of the pitchfork's primary path at some places, as accepted steps, with its bifurcation at a = 0.6.
struct Branch06 {
  Branch06() : problem(testing::pitchfork(0.6, 0.0)), solver(problem, {}) {
    auto start = find_start(solver).point;
    EXPECT_TRUE(start);
    PathPoint before = *start;
    points.add(before);
    for (const double a : {0.05, 0.5, 0.8, 0.9}) {
      PathPoint at = before;
      at.y = Eigen::Vector2d(a, 0.0);
      at.lambda = a - 0.5 * a * a;
      at.negative = a > 0.6 ? 1 : 0;
      const double norm = solver.norm().metric().norm(Eigen::Vector2d(1.0, 0.0), 1.0 - a);
      at.tangent = Eigen::Vector2d(1.0 / norm, 0.0);
      at.tangent_lambda = (1.0 - a) / norm;
      at.arc_length = before.arc_length + solver.norm().arc(before, at);
      if (a == 0.8) {
        CriticalEvent event;
        event.point = before;
        event.point.y[0] = 0.6;
        event.point.lambda = 0.42;
        event.point.arc_length = before.arc_length + solver.norm().arc(before, event.point);
        event.negative_after = 1;
        points.add_critical(event);
      }
      points.add(at);
      before = at;
    }
    length = before.arc_length;
  }

  SmallProblem problem;
  PointSolver solver;
  PathPoints points;
  double length = 0.0;
};

TEST(PathPoints, AreNoFartherApartThanAskedAndOnThePath) {
  constexpr int kCount = 40;
  Branch06 branch;
  int missing = -1;
  const auto spread = branch.points.spread(branch.solver, kCount, {}, missing);
  EXPECT_EQ(missing, 0);
  ASSERT_GE(spread.size(), static_cast<std::size_t>(kCount));
  EXPECT_LE(spread.size(), static_cast<std::size_t>(kCount) + 5) << "one more for each that was there";
  bool met = false;
  for (std::size_t i = 1; i < spread.size(); ++i) {
    const double gap = spread[i].arc_length - spread[i - 1].arc_length;
    EXPECT_GT(gap, 0.0) << i;
    EXPECT_LE(gap, branch.length / (kCount - 1) * (1.0 + 1e-6)) << i;
    const double a = spread[i].y[0];
    EXPECT_NEAR(spread[i].lambda, a - 0.5 * a * a, 1e-9) << i;
    EXPECT_EQ(spread[i].negative, a >= 0.6 ? 1 : 0) << a;
    met = met || a == 0.6;
  }
  EXPECT_TRUE(met) << "critical points are among them";
}

/// Fewer than there are leaves those that there are.
TEST(PathPoints, KeepThoseThatWereThere) {
  Branch06 branch;
  int missing = -1;
  EXPECT_EQ(branch.points.spread(branch.solver, 2, {}, missing).size(), 6U);
  EXPECT_EQ(missing, 0);
}

TEST(PathPoints, AreMissingAfterAStop) {
  Branch06 branch;
  std::stop_source stop;
  stop.request_stop();
  int missing = -1;
  EXPECT_EQ(branch.points.spread(branch.solver, 40, stop.get_token(), missing).size(), 6U);
  EXPECT_GT(missing, 30);
}

TEST(Number, IsWrittenWithTheDigitsThatItNeeds) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(std::stod(number(std::nextafter(1.0, 2.0))), std::nextafter(1.0, 2.0));
  EXPECT_EQ(rounded(0.0123456), "0.0123");
  EXPECT_EQ(rounded(1234567.0), "1.23e+06");
}

}  // namespace
}  // namespace snapthrough
