/// The path follower on problems of one and two unknowns, whose critical points are closed forms.
#include "solver/trace/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/events/branch.h"
#include "tests/solver/path/small_problem.h"
#include "tests/solver/trace/follow.h"

namespace snapthrough {
namespace {

using testing::follow;
using testing::pitchfork;
using testing::SmallProblem;
using testing::two_bifurcations;
using testing::two_folds;

TraceRules until_limit_points(int n) {
  TraceRules rules;
  rules.limit_points = n;
  rules.locate.tolerance = 1e-10;
  return rules;
}

TEST(Trace, TellsABifurcationFromALimitPoint) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  const TraceOutcome outcome = follow(problem, until_limit_points(1));
  ASSERT_EQ(outcome.critical.size(), 2u);
  EXPECT_EQ(outcome.critical[0].type, CriticalType::bifurcation);
  EXPECT_NEAR(outcome.critical[0].point.lambda, 0.42, 1e-9);
  EXPECT_EQ(outcome.critical[0].negative_before, 0);
  EXPECT_EQ(outcome.critical[0].negative_after, 1);
  EXPECT_EQ(outcome.critical[1].type, CriticalType::limit_max);
  EXPECT_NEAR(outcome.critical[1].point.lambda, 0.5, 1e-12);
  EXPECT_NEAR(outcome.critical[1].point.y[0], 1.0, 1e-5);
  EXPECT_EQ(outcome.critical[1].negative_after, 2);
  EXPECT_EQ(outcome.end, TraceEnd::limit_points);
}

/// The two critical points 1e-6 apart in the load are both found, in order.
TEST(Trace, SeparatesABifurcationJustBeforeALimitPoint) {
  const double c = 1.0 - 1e-3;
  SmallProblem problem = pitchfork(c, 0.0);
  const TraceOutcome outcome = follow(problem, until_limit_points(1));
  ASSERT_EQ(outcome.critical.size(), 2u);
  EXPECT_EQ(outcome.critical[0].type, CriticalType::bifurcation);
  EXPECT_NEAR(outcome.critical[0].point.lambda, c - 0.5 * c * c, 1e-9);
  EXPECT_EQ(outcome.critical[1].type, CriticalType::limit_max);
}

/// With an imperfection the bifurcation is gone: one limit point below it, and no step may jump across the
/// gap to the continuation of the straight path. Its load to leading order: lambda_c - 3/2 (e/2)^(2/3) ...
/// checked by its equations.
TEST(Trace, DoesNotJumpAcrossABrokenBifurcation) {
  for (const double e : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    SmallProblem problem = pitchfork(0.6, e);
    TraceRules rules = until_limit_points(1);
    rules.locate.perfect = 1e-12;
    const TraceOutcome outcome = follow(problem, rules);
    ASSERT_FALSE(outcome.critical.empty()) << e;
    EXPECT_EQ(outcome.critical.back().type, CriticalType::limit_max) << e;
    if (e < 1e-3) {
      // beside the path: the bifurcation of the perfect problem, and the size of what breaks it, over
      // lambda |d stiffness / d lambda| = 0.42 / 0.4
      ASSERT_EQ(outcome.critical.size(), 2u) << e;
      EXPECT_EQ(outcome.critical[0].type, CriticalType::broken_bifurcation) << e;
      EXPECT_NEAR(outcome.critical[0].point.lambda, 0.42, e) << e;
      EXPECT_NEAR(outcome.critical[0].imperfection, e / 1.05, 1e-2 * e) << e;
    }
    const PathPoint& limit = outcome.critical.back().point;
    const double a = limit.y[0];
    const double b = limit.y[1];
    EXPECT_GT(b, 0.0) << e;
    EXPECT_NEAR((0.6 - a) * b + b * b * b, e, 1e-9 * e + 1e-15);
    EXPECT_NEAR((1.0 - a) * (0.6 - a + 3.0 * b * b) - b * b, 0.0, 1e-6)
        << "singular tangent at the limit, e = " << e;
    EXPECT_LT(limit.lambda, 0.42);
  }
}

/// An imperfection below what is called perfect leaves the bifurcation one: the path goes on beyond it, and
/// the limit point is that of the straight path.
TEST(Trace, GoesStraightThroughABifurcationThatRoundingBreaks) {
  for (const double e : {0.0, 1e-16, 1e-14, 1e-12, 1e-10, -1e-10}) {
    SmallProblem problem = pitchfork(0.6, e);
    const TraceOutcome outcome = follow(problem, until_limit_points(1));
    ASSERT_EQ(outcome.critical.size(), 2u) << e;
    EXPECT_EQ(outcome.critical[0].type, CriticalType::bifurcation) << e;
    EXPECT_NEAR(outcome.critical[0].point.lambda, 0.42, 1e-9) << e;
    EXPECT_EQ(outcome.critical[0].negative_after, 1) << e;
    EXPECT_EQ(outcome.critical[1].type, CriticalType::limit_max) << e;
    EXPECT_NEAR(outcome.critical[1].point.lambda, 0.5, 1e-9) << e;
  }
}

/// Two critical points that leave the inertia as it was are found wherever they lie in a step, or the path
/// says where it cannot tell; and where the stiffness does not reach zero nothing is found.
TEST(Trace, FindsPairsInsideAStep) {
  for (const bool folds : {false, true}) {
    for (const double place : {0.0, 0.013, 0.11, 0.27, 0.41, 0.5, 0.66, 0.83, 0.97}) {
      for (double d = 0.1; d > 0.9e-8; d *= 0.1) {
        const double c = 1.3 + place;
        SmallProblem problem = folds ? two_folds(c, d) : two_bifurcations(c, d);
        TraceRules rules;
        rules.monitor = {[](const PathPoint& at) { return at.y[0]; }, {-1.0, 3.5}};
        rules.locate.tolerance = 1e-10;
        int told = 0;
        testing::Observed observer;
        observer.touching = [&](const PathPoint& at) {
          EXPECT_NEAR(at.y[0], c, 1e-3);
          ++told;
        };
        const TraceOutcome outcome = follow(problem, rules, {&observer});
        EXPECT_EQ(outcome.end, TraceEnd::monitor) << folds << " " << c << " " << d;
        if (outcome.critical.empty()) {
          EXPECT_EQ(told, 1) << folds << " " << c << " " << d;
          EXPECT_LT(d, 1e-3) << folds << " " << c;
          continue;
        }
        ASSERT_EQ(outcome.critical.size(), 2u) << folds << " " << c << " " << d;
        EXPECT_NEAR(outcome.critical[0].point.y[0], c - d, 1e-2 * d + 1e-8) << folds << " " << c << " " << d;
        EXPECT_NEAR(outcome.critical[1].point.y[0], c + d, 1e-2 * d + 1e-8) << folds << " " << c << " " << d;
      }
    }
  }
}

/// A straight path x = lambda beside which a motion has the stiffness 1 - b q(a) + c / (1 + exp((1 - a) /
/// w)), a = x - x0, where q rises smoothly from 0 at a = 0 to 1 at a = 1: it is lost before a support acts at
/// a = 1.
SmallProblem knee(double b, double c, double w, double x0) {
  const auto stiffness = [=](double x) {
    const double a = std::clamp(x - x0, 0.0, 1.0);
    return 1.0 - b * a * a * (3.0 - 2.0 * a) + c / (1.0 + std::exp((1.0 + x0 - x) / w));
  };
  const auto gradient = [=](const Eigen::VectorXd& y) {
    return Eigen::VectorXd(Eigen::Vector2d(y[0], stiffness(y[0]) * y[1]));
  };
  const auto hessian = [=](const Eigen::VectorXd& y) {
    return Eigen::MatrixXd(Eigen::Vector2d(1.0, stiffness(y[0])).asDiagonal());
  };
  return {gradient, hessian, Eigen::Vector2d(1.0, 0.0)};
}

void expect_pair_before_knee(double b, double c, double w, double x0) {
  SmallProblem problem = knee(b, c, w, x0);
  TraceRules rules;
  rules.monitor = {[](const PathPoint& at) { return at.y[0]; }, {-1.0, x0 + 3.0}};
  rules.gradient = 10.0;
  const TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.critical.size(), 2u) << b << " " << c << " " << w << " " << x0;
}

/// Steps of a straight path grow, and one of them holds the loss of stability and its end.
TEST(Trace, FindsPairsBeforeAKnee) {
  for (const double b : {1.4, 1.8}) {
    for (const double x0 : {0.5, 1.3, 2.9}) {
      expect_pair_before_knee(b, 10.0, 0.01, x0);
      expect_pair_before_knee(b, 10.0, 0.03, x0);
      expect_pair_before_knee(b, 100.0, 0.01, x0);
      expect_pair_before_knee(b, 100.0, 0.03, x0);
    }
  }
}

/// Two-bar truss of half span 1, rise h, bars with EA = 1 and engineering strain, and a one-sided spring
/// under the apex: P = 2 y (1/L - 1/L0) + ks max(w - g, 0), y = h - w, L = sqrt(1 + y^2). Smooth folds where
/// L^3 = L0.
SmallProblem truss(double h, double ks, double g) {
  const double l0 = std::sqrt(1.0 + h * h);
  return {[=](const Eigen::VectorXd& w) {
            const double y = h - w[0];
            const double l = std::sqrt(1.0 + y * y);
            return Eigen::VectorXd(
                Eigen::VectorXd::Constant(1, 2.0 * y * (1.0 / l - 1.0 / l0) + ks * std::max(w[0] - g, 0.0)));
          },
          [=](const Eigen::VectorXd& w) {
            const double y = h - w[0];
            const double l = std::sqrt(1.0 + y * y);
            return Eigen::MatrixXd(Eigen::MatrixXd::Constant(
                1, 1, 2.0 * (1.0 / l0 - 1.0 / (l * l * l)) + (w[0] > g ? ks : 0.0)));
          },
          Eigen::VectorXd::Ones(1), ks > 0.0};
}

struct TrussFold {
  double h, ks, g;
  CriticalType type;
  double w, P;
};

/// Closed forms, 13 digits; a gap of 10 stands for "no spring".
class TrussFolds : public ::testing::TestWithParam<TrussFold> {};

TEST_P(TrussFolds, AreFoundWithTheirLoads) {
  const TrussFold expected = GetParam();
  SmallProblem problem = truss(expected.h, expected.ks, expected.g);
  const TraceOutcome outcome = follow(problem, until_limit_points(2));
  bool seen = false;
  for (const CriticalEvent& event : outcome.critical) {
    if (event.type != expected.type || std::abs(event.point.y[0] - expected.w) > 1e-4) continue;
    seen = true;
    EXPECT_NEAR(event.point.lambda, expected.P, 1e-9 * std::abs(expected.P));
  }
  EXPECT_TRUE(seen);
}

INSTANTIATE_TEST_SUITE_P(
    ClosedForms, TrussFolds,
    ::testing::Values(
        TrussFold{0.2, 0.0, 10.0, CriticalType::limit_max, 0.08528555531156, 0.0029605176007631},
        TrussFold{0.2, 0.0, 10.0, CriticalType::limit_min, 0.31471444468844, -0.0029605176007631},
        TrussFold{0.2, 0.068096461460718, 0.16, CriticalType::limit_min, 0.16, 0.0014896226424695},
        TrussFold{0.2, 0.0013619292292144, 0.04264277765578, CriticalType::limit_max, 0.087347366571359,
                  0.0030199940933367},
        TrussFold{0.5, 0.0, 10.0, CriticalType::limit_max, 0.22211990892484, 0.038383739817435},
        TrussFold{0.5, 0.0, 10.0, CriticalType::limit_min, 0.77788009107516, -0.038383739817435},
        TrussFold{0.5, 0.36303258336663, 0.4, CriticalType::limit_min, 0.4, 0.020121999842015},
        TrussFold{1.0, 0.0, 10.0, CriticalType::limit_max, 0.49017547146604, 0.18740327521162},
        TrussFold{1.0, 0.94303701252658, 0.8, CriticalType::limit_min, 0.8, 0.10938955780175},
        TrussFold{1.0, 0.018860740250532, 0.24508773573302, CriticalType::limit_max, 0.5011592614225,
                  0.19212939774265}));

/// The path through the bifurcation of the perfect problem: b^2 = a - c, lambda = a - a^2/2 - (a - c)/2.
TEST(Branch, LeavesAPitchforkBothWays) {
  const double c = 0.6;
  for (const double sign : {1.0, -1.0}) {
    SmallProblem problem = pitchfork(c, 0.0);
    PathFollower follower(problem);
    TraceRules rules;
    rules.first_loss_of_stability = true;
    const TraceOutcome primary = trace(follower, find_start(follower.solver()).point, rules, {}, {}, {});
    ASSERT_EQ(primary.critical.size(), 1u);
    const auto first = first_point_of_branch(follower, primary.critical[0], sign);
    ASSERT_TRUE(first);
    EXPECT_GT(sign * first->y[1], 0.0);
    TraceRules until;
    until.monitor = {[](const PathPoint& at) { return at.y[1]; }, {-0.5, 0.5}};
    until.first_step = 0.02;
    const TraceOutcome branch = trace(follower, first, until, {}, {}, {});
    EXPECT_EQ(branch.end, TraceEnd::monitor);
    const double a = branch.last.y[0];
    EXPECT_NEAR(branch.last.y[1], 0.5 * sign, 1e-11);
    EXPECT_NEAR(a, c + 0.25, 1e-10);
    EXPECT_NEAR(branch.last.lambda, a - 0.5 * a * a - 0.125, 1e-10);
    EXPECT_TRUE(branch.critical.empty());
  }
}

TEST(Trace, EndsExactlyAtALoadBound) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  TraceRules rules;
  rules.load = {{-1.0, 0.3}};
  const TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::load_factor);
  EXPECT_NEAR(outcome.last.lambda, 0.3, 1e-12);
  EXPECT_NEAR(outcome.last.y[0], 1.0 - std::sqrt(0.4), 1e-11);
}

TEST(Trace, EndsExactlyAtAMonitorBound) {
  SmallProblem problem = pitchfork(2.0, 0.0);
  TraceRules rules;
  rules.monitor = {[](const PathPoint& at) { return at.y[0]; }, {-1.0, 1.5}};
  const TraceOutcome outcome = follow(problem, rules);
  EXPECT_EQ(outcome.end, TraceEnd::monitor);
  EXPECT_NEAR(outcome.last.y[0], 1.5, 1e-12);
  EXPECT_NEAR(outcome.last.lambda, 0.375, 1e-11);
  ASSERT_EQ(outcome.critical.size(), 1u) << "the limit point at a = 1 lies before the bound";
}

TEST(Trace, StopsWhenAskedTo) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  PathFollower follower(problem);
  std::stop_source source;
  source.request_stop();
  const TraceOutcome outcome =
      trace(follower, find_start(follower.solver()).point, until_limit_points(1), {}, {}, source.get_token());
  EXPECT_EQ(outcome.end, TraceEnd::cancelled);
}

TEST(Trace, ReportsPointsInOrderOfArcLength) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  std::vector<double> lengths;
  testing::Observed observer;
  observer.point = [&lengths](const PathPoint& at) { lengths.push_back(at.arc_length); };
  const TraceOutcome outcome = follow(problem, until_limit_points(1), {&observer});
  ASSERT_GT(lengths.size(), 3u);
  for (std::size_t i = 1; i < lengths.size(); ++i) EXPECT_GT(lengths[i], lengths[i - 1]);
  EXPECT_EQ(lengths.back(), outcome.last.arc_length);
}

}  // namespace
}  // namespace snapthrough
