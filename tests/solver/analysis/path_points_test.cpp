/// Points evenly along a branch: of a path that is known in closed form.
#include "solver/analysis/path_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

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
    points.add(before, std::nullopt);
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
      points.add(at, std::nullopt);
      before = at;
    }
    length = before.arc_length;
  }

  SmallProblem problem;
  PointSolver solver;
  PathPoints points;
  double length = 0.0;
};

/// What was visited, and what was missing.
struct Rows {
  std::vector<PathRow> rows;
  int missing = 0;
};

Rows spread_rows(Branch06& branch, int count, const std::stop_token& stop = {}) {
  Rows out;
  out.missing =
      branch.points.spread(branch.solver, count, stop, [&out](PathRow& row) { out.rows.push_back(row); });
  return out;
}

/// Shown is the displacement a.
Eigen::VectorXd shown(const Eigen::VectorXd& y) { return y.head(1); }

Rows followed_rows(PathPoints& points, PointSolver& solver) {
  Rows out;
  out.missing = points.follow(solver, shown, true, {}, [&out](PathRow& row) { out.rows.push_back(row); });
  return out;
}

TEST(PathPoints, AreNoFartherApartThanAskedAndOnThePath) {
  constexpr int kCount = 40;
  Branch06 branch;
  const Rows found = spread_rows(branch, kCount);
  EXPECT_EQ(found.missing, 0);
  std::vector<PathPoint> spread;
  for (const PathRow& row : found.rows) {
    EXPECT_TRUE(row.computed);
    spread.push_back(row.point);
  }
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
    // rates by arc length: both turn as the closed form does; a bifurcation's is that of a parabola
    EXPECT_NEAR(spread[i].tangent_lambda, (1.0 - a) * spread[i].tangent[0], a == 0.6 ? 1e-3 : 1e-8) << a;
    met = met || a == 0.6;
  }
  EXPECT_TRUE(met) << "critical points are among them";
}

/// Fewer than there are leaves those that there are.
TEST(PathPoints, KeepThoseThatWereThere) {
  Branch06 branch;
  const Rows found = spread_rows(branch, 2);
  EXPECT_EQ(found.rows.size(), 6U);
  EXPECT_EQ(found.missing, 0);
}

TEST(PathPoints, AreMissingAfterAStop) {
  Branch06 branch;
  std::stop_source stop;
  stop.request_stop();
  const Rows found = spread_rows(branch, 40, stop.get_token());
  EXPECT_EQ(found.rows.size(), 6U);
  EXPECT_GT(found.missing, 30);
}

/// Largest distance of the closed form from straight lines between rows, over its ranges.
double off_lines(const std::vector<PathRow>& rows) {
  const double wide = rows.back().point.y[0] - rows.front().point.y[0];
  const double tall = rows.back().point.lambda - rows.front().point.lambda;
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const PathPoint& from = rows[i].point;
    const PathPoint& to = rows[i + 1].point;
    const Eigen::Vector2d chord((to.y[0] - from.y[0]) / wide, (to.lambda - from.lambda) / tall);
    for (int k = 1; k < 20; ++k) {
      const double a = from.y[0] + k / 20.0 * (to.y[0] - from.y[0]);
      const Eigen::Vector2d offset((a - from.y[0]) / wide, (a - 0.5 * a * a - from.lambda) / tall);
      largest = std::max(largest, std::abs(chord[0] * offset[1] - chord[1] * offset[0]) / chord.norm());
    }
  }
  return largest;
}

/// The bound of straight lines is what docs/results.md promises, that of inserted points a fifth of it.
TEST(PathPoints, FollowTheCurveByStraightLines) {
  Branch06 branch;
  const Rows found = followed_rows(branch.points, branch.solver);
  EXPECT_EQ(found.missing, 0);
  EXPECT_GT(found.rows.size(), 6U) << "straight lines between the accepted points are not enough";
  EXPECT_LT(off_lines(found.rows), 0.01);
  bool met = false;
  for (const PathRow& row : found.rows) {
    const double a = row.point.y[0];
    EXPECT_NEAR(row.point.lambda, a - 0.5 * a * a, row.computed ? 1e-9 : 0.002 * 0.5);
    EXPECT_EQ(row.point.negative, a >= 0.6 ? 1 : 0) << a;
    met = met || (a == 0.6 && row.computed);
  }
  EXPECT_TRUE(met) << "critical points are among them";
}

/// The parts of a bent bar, f = a below a = 1/2 and 3 a - 1 above: the lines lead through the kink.
TEST(PathPoints, FollowAKink) {
  const auto force = [](double a) { return a < 0.5 ? a : 3.0 * a - 1.0; };
  SmallProblem problem(
      [force](const Eigen::VectorXd& y) { return Eigen::VectorXd(Eigen::Vector2d(force(y[0]), y[1])); },
      [](const Eigen::VectorXd& y) {
        return Eigen::MatrixXd(Eigen::Vector2d(y[0] < 0.5 ? 1.0 : 3.0, 1.0).asDiagonal());
      },
      Eigen::Vector2d(1.0, 0.0), true);
  PointSolver solver(problem, {});
  PathPoints points;
  PathPoint before = *find_start(solver).point;
  points.add(before, std::nullopt);
  for (const double a : {0.2, 0.4, 0.8, 1.0}) {
    PathPoint at = before;
    at.y = Eigen::Vector2d(a, 0.0);
    at.lambda = force(a);
    const double slope = a < 0.5 ? 1.0 : 3.0;
    const double norm = solver.norm().metric().norm(Eigen::Vector2d(1.0, 0.0), slope);
    at.tangent = Eigen::Vector2d(1.0 / norm, 0.0);
    at.tangent_lambda = slope / norm;
    at.arc_length = before.arc_length + solver.norm().arc(before, at);
    points.add(at, std::nullopt);
    before = at;
  }
  const Rows found = followed_rows(points, solver);
  EXPECT_EQ(found.missing, 0);
  EXPECT_LT(found.rows.size(), 20U);
  double nearest = 1.0;
  for (const PathRow& row : found.rows) {
    EXPECT_NEAR(row.point.lambda, force(row.point.y[0]), 0.002 * 2.0) << row.point.y[0];
    nearest = std::min(nearest, std::abs(row.point.y[0] - 0.5));
  }
  EXPECT_LT(nearest, 0.01);
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
