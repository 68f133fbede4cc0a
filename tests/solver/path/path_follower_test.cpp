/// One step of a path in closed form, a kink, and places on a segment.
#include "solver/path/path_follower.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/path/segment.h"
#include "tests/solver/path/small_problem.h"

namespace snapthrough {
namespace {

using testing::pitchfork;
using testing::SmallProblem;

/// The stiffness jumps from 1 to `beyond` at a = 1, as where a support begins or ceases to act.
SmallProblem corner(double beyond) {
  return {[=](const Eigen::VectorXd& y) {
            const double a = y[0];
            return Eigen::VectorXd(Eigen::VectorXd::Constant(1, a < 1.0 ? a : 1.0 + beyond * (a - 1.0)));
          },
          [=](const Eigen::VectorXd& y) {
            return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, y[0] < 1.0 ? 1.0 : beyond));
          },
          Eigen::VectorXd::Ones(1), true};
}

/// lambda = a - a^2/2 on the primary path, whose first tangent is (1, 1) over its norm.
TEST(PathFollower, TakesAStepOnThePath) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  PathFollower follower(problem);
  const PathStart start = find_start(follower.solver());
  ASSERT_TRUE(start);
  EXPECT_GT(start.point->tangent_lambda, 0.0);
  StepSize size{0.0, 0.05};
  PathPoint to;
  ASSERT_EQ(follower.step(*start.point, size, to), StepOutcome::advanced);
  EXPECT_EQ(size.taken, 0.05);
  EXPECT_GT(size.wanted, 0.0);
  EXPECT_NEAR(to.lambda, to.y[0] - 0.5 * to.y[0] * to.y[0], 1e-12);
  EXPECT_NEAR(to.tangent_lambda / to.tangent[0], 1.0 - to.y[0], 1e-9);
  EXPECT_NEAR(to.arc_length, 0.05, 1e-3);
  EXPECT_EQ(follower.statistics().steps, 1);
  follower.reject(size);
  EXPECT_EQ(follower.statistics().steps, 0);
  EXPECT_LT(size.wanted, 0.05);
}

/// The path goes back almost against its tangent beyond a = 1: no step along the tangent meets it again.
TEST(PathFollower, GoesRoundAKink) {
  SmallProblem problem = corner(-1e4);
  PathFollower follower(problem);
  PathPoint from = *find_start(follower.solver()).point;
  StepSize size{0.0, 0.1};
  PathPoint to;
  StepOutcome outcome = StepOutcome::advanced;
  for (int n = 0; n < 200 && outcome == StepOutcome::advanced; ++n) {
    outcome = follower.step(from, size, to);
    if (outcome == StepOutcome::advanced) std::swap(from, to);
  }
  ASSERT_EQ(outcome, StepOutcome::kinked);
  EXPECT_LT(from.y[0], 1.0);
  EXPECT_GT(to.y[0], 1.0);
  EXPECT_LT(to.tangent_lambda, 0.0) << "the load turns where one support's change makes a stiffness negative";
  EXPECT_EQ(to.negative, 1);
  const PathPoint last = follower.last_point_before_kink(from, size.taken);
  EXPECT_LT(last.y[0], 1.0);
  EXPECT_NEAR(last.y[0], 1.0, 1e-10);
}

/// Bounds of the request on step sizes are fractions of the load scale.
TEST(PathFollower, KeepsTheRequestsLargestStep) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  PathFollower follower(problem);
  const PathPoint start = *find_start(follower.solver()).point;
  StepOptions steps;
  steps.max = 0.01;
  follower.limit_steps(steps, start.tangent_lambda);
  StepSize size{0.0, 10.0};
  PathPoint to;
  ASSERT_EQ(follower.step(start, size, to), StepOutcome::advanced);
  EXPECT_NEAR(to.lambda, 0.01 * follower.norm().load_scale(), 1e-4 * follower.norm().load_scale());
}

/// Halfway between two points of lambda = a - a^2/2, in the plane across the straight line.
TEST(Segment, HasThePathsPointAtAFraction) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  PathFollower follower(problem);
  const PathPoint start = *find_start(follower.solver()).point;
  StepSize size{0.0, 0.2};
  PathPoint to;
  ASSERT_EQ(follower.step(start, size, to), StepOutcome::advanced);
  const Segment segment(follower.solver(), start, to);
  EXPECT_NEAR(segment.length(), follower.norm().distance(start, to), 1e-14);
  const auto middle = segment.point_at(0.5);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->lambda, middle->y[0] - 0.5 * middle->y[0] * middle->y[0], 1e-12);
  EXPECT_NEAR(segment.length_to(*middle), 0.5 * segment.length(), 1e-12);
  EXPECT_EQ(middle->negative, 0);
  PathPoint guess;
  segment.interpolate(0.5, guess);
  EXPECT_NEAR(guess.y[0], middle->y[0], 1e-4);
  const Segment first_half = segment.part(start, *middle);
  EXPECT_NEAR(first_half.length(), 0.5 * segment.length(), 1e-12);
}

}  // namespace
}  // namespace snapthrough
