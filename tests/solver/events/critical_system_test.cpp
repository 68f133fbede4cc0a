/// Critical points as solutions of equations of their own, on problems whose solutions are closed forms.
#include "solver/events/critical_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/solver/path/small_problem.h"

namespace snapthrough {
namespace {

using testing::pitchfork;
using testing::SmallProblem;

CriticalOptions within(double reach) {
  CriticalOptions options;
  options.reach = reach;
  return options;
}

/// Of the pitchfork with its bifurcation at a = 0.6, load 0.42, from a guess beside it.
std::optional<CriticalSolution> bifurcation(SmallProblem& problem, double a, double b,
                                            const CriticalOptions& options, int& factorisations) {
  const PathMetric metric{&problem.metric(), 1.0};
  const CriticalGuess guess{Eigen::Vector2d(a, b), a - 0.5 * a * a, Eigen::Vector2d(0.0, 1.0)};
  return solve_bifurcation(problem, metric, guess, options, factorisations);
}

TEST(CriticalSystem, SolvesForABifurcation) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  int factorisations = 0;
  const auto found = bifurcation(problem, 0.57, 0.01, within(0.2), factorisations);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lambda, 0.42, 1e-9 * 0.42);
  EXPECT_NEAR(found->y[0], 0.6, 1e-9);
  EXPECT_NEAR(found->y[1], 0.0, 1e-9);
  EXPECT_NEAR(std::abs(found->null(1, 0)), 1.0, 1e-9);
  EXPECT_EQ(found->others, 0);
  EXPECT_NEAR(found->imperfection(), 0.0, 1e-9);
  // the stiffness c - a changes with the load by -1 / (1 - c)
  EXPECT_NEAR(found->B(0, 0), -2.5, 1e-5);
  EXPECT_GT(factorisations, 0);
  EXPECT_LE(factorisations, 8);
}

/// Along the primary path d(a, lambda) = (1, 0.4); across it b alone, which leaves the load.
TEST(CriticalSystem, HasTheTangentsOfBothPaths) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  int factorisations = 0;
  const auto found = bifurcation(problem, 0.6, 0.0, within(0.2), factorisations);
  ASSERT_TRUE(found);
  const PathMetric metric{&problem.metric(), 1.0};
  auto tangents = found->tangents(metric);
  ASSERT_EQ(tangents.size(), 2U);
  if (std::abs(tangents[0].y[0]) < std::abs(tangents[1].y[0])) std::swap(tangents[0], tangents[1]);
  EXPECT_NEAR(std::abs(tangents[0].y[0]), 1.0 / std::sqrt(1.16), 1e-6);
  EXPECT_NEAR(tangents[0].lambda / tangents[0].y[0], 0.4, 1e-6);
  EXPECT_NEAR(tangents[0].y[1], 0.0, 1e-6);
  EXPECT_NEAR(std::abs(tangents[1].y[1]), 1.0, 1e-6);
  EXPECT_NEAR(tangents[1].lambda, 0.0, 1e-6);
}

/// A force e that breaks the bifurcation is found with it: over load times rate of the stiffness, 0.42 * 2.5.
TEST(CriticalSystem, MeasuresWhatBreaksABifurcation) {
  for (const double e : {1e-3, 1e-5, 1e-8}) {
    SmallProblem problem = pitchfork(0.6, e);
    int factorisations = 0;
    const auto found = bifurcation(problem, 0.58, 0.0, within(0.2), factorisations);
    ASSERT_TRUE(found) << e;
    EXPECT_NEAR(found->imperfection(), e / 1.05, 1e-3 * e) << e;
    EXPECT_NEAR(found->lambda, 0.42, 10.0 * e) << e;
  }
}

TEST(CriticalSystem, DoesNotGoFartherThanItMay) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  int factorisations = 0;
  EXPECT_TRUE(bifurcation(problem, 0.5, 0.0, within(0.2), factorisations));
  EXPECT_FALSE(bifurcation(problem, 0.5, 0.0, within(0.05), factorisations));
}

TEST(CriticalSystem, SolvesForALimitPoint) {
  SmallProblem problem = testing::two_folds(2.0, 0.5);
  const PathMetric metric{&problem.metric(), 1.0};
  const double at_start = 13.0 / 6.0;
  for (const double sign : {-1.0, 1.0}) {
    const CriticalGuess guess{Eigen::VectorXd::Constant(1, 2.0 + 0.6 * sign), at_start,
                              Eigen::MatrixXd::Ones(1, 1)};
    int factorisations = 0;
    const auto found = solve_limit_point(problem, metric, guess, within(1.0), factorisations);
    ASSERT_TRUE(found) << sign;
    EXPECT_NEAR(found->y[0], 2.0 + 0.5 * sign, 1e-6);
    // -+ 1/12 beside the start's 13/6
    EXPECT_NEAR(found->lambda, at_start - sign / 12.0, 1e-9 * at_start);
    EXPECT_EQ(found->unfolding.size(), 0);
  }
}

/// lambda = a + a^3 never turns.
TEST(CriticalSystem, FindsNoLimitPointWhereThereIsNone) {
  SmallProblem problem([](const Eigen::VectorXd& y) { return Eigen::VectorXd(y.array() + y.array().cube()); },
                       [](const Eigen::VectorXd& y) {
                         return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, 1.0 + 3.0 * y[0] * y[0]));
                       },
                       Eigen::VectorXd::Ones(1));
  const PathMetric metric{&problem.metric(), 1.0};
  const CriticalGuess guess{Eigen::VectorXd::Constant(1, 0.4), 0.464, Eigen::MatrixXd::Ones(1, 1)};
  int factorisations = 0;
  EXPECT_FALSE(solve_limit_point(problem, metric, guess, within(2.0), factorisations));
}

}  // namespace
}  // namespace snapthrough
