/// Each rule that ends a path, and each way to fail, on problems of one and two unknowns.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/trace/trace.h"
#include "tests/solver/newton/scalar_problem.h"
#include "tests/solver/path/failing_problem.h"
#include "tests/solver/path/small_problem.h"
#include "tests/solver/trace/follow.h"

namespace snapthrough {
namespace {

using testing::FailingProblem;
using testing::follow;
using testing::pitchfork;
using testing::ScalarProblem;
using testing::SmallProblem;

TEST(TraceEnd, AtItsLastStep) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  TraceRules rules;
  rules.steps = 3;
  int points = 0;
  testing::Observed observer;
  observer.point = [&points](const PathPoint&) { ++points; };
  const TraceOutcome outcome = follow(problem, rules, {&observer});
  EXPECT_EQ(outcome.end, TraceEnd::steps);
  EXPECT_EQ(points, 4) << "the start, and three";
  EXPECT_GT(outcome.last.lambda, 0.0);
}

TEST(TraceEnd, AtTheFirstLossOfStability) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  TraceRules rules;
  rules.first_loss_of_stability = true;
  const TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::critical_point);
  ASSERT_EQ(outcome.critical.size(), 1U);
  EXPECT_NEAR(outcome.last.lambda, 0.42, 1e-8);
}

TEST(TraceEnd, AtOnceWhereItIsUnstableAlready) {
  SmallProblem problem = pitchfork(-0.1, 0.0);
  TraceRules rules;
  rules.first_loss_of_stability = true;
  const TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::unstable_at_start);
  EXPECT_EQ(outcome.last.lambda, 0.0);
}

/// The primary path loses stability at its bifurcation (0.42) and again at its limit point (0.5).
TEST(TraceEnd, WhereTooManyEigenvaluesAreNegative) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  TraceRules rules;
  rules.most_negative = 0;
  TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::negative_eigenvalues);
  EXPECT_TRUE(outcome.on_critical);
  EXPECT_EQ(outcome.last.negative, 1);
  EXPECT_NEAR(outcome.last.lambda, 0.42, 1e-8);
  rules.most_negative = 1;
  outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::negative_eigenvalues);
  EXPECT_NEAR(outcome.last.lambda, 0.5, 1e-8);
  rules.most_negative_waits = [](const PathPoint&) { return true; };
  EXPECT_NE(follow(problem, rules).end, TraceEnd::negative_eigenvalues);
}

TEST(TraceEnd, AtOnceWhereTooManyAreNegativeAlready) {
  SmallProblem problem = pitchfork(-0.1, 0.0);
  TraceRules rules;
  rules.most_negative = 0;
  const TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::negative_eigenvalues);
  EXPECT_FALSE(outcome.on_critical);
  EXPECT_EQ(outcome.last.lambda, 0.0);
}

/// lambda = 1/2 is the most that the monitor, here the load itself, can reach.
TEST(TraceEnd, WhereTheMonitorTurns) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  TraceRules rules;
  const auto load = [](const PathPoint& at) { return at.lambda; };
  rules.monitor = {load, {-10.0, 10.0}};
  rules.controlled = {load, [](const PathPoint& at) { return at.tangent_lambda; }};
  const TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::monitor_turned);
  EXPECT_NEAR(outcome.last.lambda, 0.5, 1e-6);
}

/// f(a) = a goes on for ever.
TEST(TraceEnd, WhereTheStructureLeavesForInfinity) {
  ScalarProblem problem([](double a) { return a; }, [](double) { return 1.0; });
  const TraceOutcome outcome = follow(problem, {});
  EXPECT_EQ(outcome.end, TraceEnd::displacement_bound);
  EXPECT_GE(std::abs(outcome.last.y[0]), 4.0);
}

/// f(a) = a / (1 - a) hardly moves any more, whatever the load.
TEST(TraceEnd, WhereTheLoadLeavesForInfinity) {
  SmallProblem problem(
      [](const Eigen::VectorXd& y) { return Eigen::VectorXd(y.array() / (1.0 - y.array())); },
      [](const Eigen::VectorXd& y) {
        return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, std::pow(1.0 - y[0], -2)));
      },
      Eigen::VectorXd::Ones(1));
  const TraceOutcome outcome = follow(problem, {});
  EXPECT_EQ(outcome.end, TraceEnd::load_bound);
  EXPECT_NEAR(outcome.last.y[0], outcome.last.lambda / (1.0 + outcome.last.lambda), 1e-9);
}

/// Beyond a = 0.3 no step can end: the last point is before it, as near as steps can get.
TEST(TraceEnd, InUnderflowWhereNothingConverges) {
  FailingProblem problem([] { return pitchfork(0.6, 0.0); }, {0.3, 1e9}, FailingProblem::How::no_number);
  const TraceOutcome outcome = follow(problem, {});
  EXPECT_EQ(outcome.end, TraceEnd::step_underflow);
  EXPECT_LE(outcome.last.y[0], 0.3);
  EXPECT_GT(outcome.last.y[0], 0.29);
  EXPECT_TRUE(outcome.critical.empty());
}

/// What was reached stays.
TEST(TraceEnd, WhereItIsCancelled) {
  FailingProblem problem([] { return pitchfork(0.6, 0.0); }, {0.3, 1e9}, FailingProblem::How::cancelled);
  const TraceOutcome outcome = follow(problem, {});
  EXPECT_EQ(outcome.end, TraceEnd::cancelled);
  EXPECT_GT(outcome.last.y[0], 0.0);
  EXPECT_LE(outcome.last.y[0], 0.3);
}

/// f(a) = a^2 has no stiffness to start with.
TEST(TraceEnd, BeforeItStartsWhereTheTangentIsSingular) {
  ScalarProblem problem([](double a) { return a * a; }, [](double a) { return 2.0 * a; });
  PathFollower follower(problem);
  const PathStart start = find_start(follower.solver());
  EXPECT_FALSE(start);
  EXPECT_EQ(trace(follower, start.point, {}, {}, {}, {}).end, TraceEnd::no_start);
}

/// A path that meets a critical point of another branch has rejoined it.
TEST(TraceEnd, WhereItMeetsAnotherBranch) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  PathFollower follower(problem);
  const PathStart start = find_start(follower.solver());
  ASSERT_TRUE(start);
  TraceRules rules;
  const TraceOutcome first = [&] {
    TraceRules once;
    once.first_loss_of_stability = true;
    return trace(follower, start.point, once, {}, {}, {});
  }();
  ASSERT_EQ(first.critical.size(), 1U);
  rules.known = {first.critical[0].point};
  const TraceOutcome outcome = trace(follower, start.point, rules, {}, {}, {});
  EXPECT_EQ(outcome.end, TraceEnd::rejoined);
  EXPECT_NEAR(outcome.last.lambda, 0.42, 1e-6);
}

}  // namespace
}  // namespace snapthrough
