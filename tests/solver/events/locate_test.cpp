/// The locator between two points of a path that is known in closed form: what it finds, how it tells what it
/// can't separate, and each way in which it does not find anything.
#include "solver/events/locate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "solver/events/hidden_events.h"
#include "solver/events/root_finder.h"
#include "solver/numeric/cancelled.h"
#include "tests/solver/path/failing_problem.h"
#include "tests/solver/path/small_problem.h"

namespace snapthrough {
namespace {

using testing::FailingProblem;
using testing::pitchfork;
using testing::SmallProblem;

/// A point of a path with its exact tangent, inertia and determinant.
PathPoint point_of(const PathNorm& path_norm, EquilibriumProblem& problem, Eigen::VectorXd y, double lambda,
                   Eigen::VectorXd dy, double dlambda) {
  PathPoint at;
  Eigen::VectorXd f;
  const TangentReport report = problem.linearise(y, lambda, f);
  EXPECT_LT(f.norm(), 1e-13) << "not on the path";
  const double norm = path_norm.metric().norm(dy, dlambda);
  at.y = std::move(y);
  at.lambda = lambda;
  at.tangent = dy / norm;
  at.tangent_lambda = dlambda / norm;
  at.negative = report.negative;
  at.log_abs_det = report.log_abs_det;
  return at;
}

/// A started follower of a problem, so that its norm is that of a path.
struct Follower {
  explicit Follower(EquilibriumProblem& p) : problem(p), solver(p, {}) { EXPECT_TRUE(find_start(solver)); }
  /// Of the pitchfork's primary path b = 0, lambda = a - a^2/2.
  [[nodiscard]] PathPoint primary(double a) {
    return point_of(solver.norm(), problem, Eigen::Vector2d(a, 0.0), a - 0.5 * a * a,
                    Eigen::Vector2d(1.0, 0.0), 1.0 - a);
  }
  /// All critical points between two points.
  /// @param modes whether the softest motions are known at both, as they are along a path
  [[nodiscard]] LocatedEvents between(PathPoint a, PathPoint b, bool modes, const LocateOptions& options) {
    b.arc_length = a.arc_length + solver.norm().arc(a, b);
    for (PathPoint* at : {&a, &b}) {
      if (!modes) continue;
      Eigen::VectorXd f;
      problem.linearise(at->y, at->lambda, f);
      solver.find_modes(*at, nullptr);
    }
    return locate_critical_points(solver, a, b, options);
  }

  EquilibriumProblem& problem;
  PointSolver solver;
};

constexpr double kTolerance = 1e-9;

/// Both ways to a simple point: bracketed by the sign of the determinant, or by Newton's method from the
/// softest motions.
class SimplePoint : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(ByModesOrBracket, SimplePoint, ::testing::Bool(),
                         [](const auto& p) { return p.param ? "Newton" : "Bracket"; });

TEST_P(SimplePoint, IsABifurcationWhereTheLoadGoesOn) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  Follower path(problem);
  const LocatedEvents found = path.between(path.primary(0.45), path.primary(0.7), GetParam(), {kTolerance});
  ASSERT_TRUE(found.same_path);
  ASSERT_EQ(found.events.size(), 1U);
  const CriticalEvent& event = found.events[0];
  EXPECT_EQ(event.null.size() > 0, GetParam()) << "the other way was taken";
  EXPECT_EQ(event.type, CriticalType::bifurcation);
  EXPECT_EQ(event.cause, CriticalCause::smooth);
  EXPECT_NEAR(event.point.lambda, 0.42, kTolerance * 0.42);
  EXPECT_NEAR(event.point.y[0], 0.6, 1e-8);
  EXPECT_EQ(event.negative_before, 0);
  EXPECT_EQ(event.negative_after, 1);
  EXPECT_EQ(event.multiplicity, 1);
  EXPECT_LE(std::abs(event.bracket_loads[1] - event.bracket_loads[0]), kTolerance * 0.42);
  // the path goes straight on
  EXPECT_NEAR(event.point.tangent[1], 0.0, 1e-9);
  EXPECT_GT(event.point.tangent[0], 0.0);
}

TEST_P(SimplePoint, IsALimitPointWhereTheLoadTurns) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  Follower path(problem);
  const LocatedEvents found = path.between(path.primary(0.8), path.primary(1.4), GetParam(), {kTolerance});
  ASSERT_EQ(found.events.size(), 1U);
  const CriticalEvent& event = found.events[0];
  EXPECT_EQ(event.null.size() > 0, GetParam());
  EXPECT_EQ(event.type, CriticalType::limit_max);
  EXPECT_EQ(event.cause, CriticalCause::smooth);
  EXPECT_NEAR(event.point.lambda, 0.5, kTolerance * 0.5);
  EXPECT_NEAR(event.point.y[0], 1.0, 1e-4);
  EXPECT_EQ(event.negative_before, 0);
  EXPECT_EQ(event.negative_after, 1);
}

/// The way back has its minimum where the way there has its maximum, in the other order of the inertia.
TEST_P(SimplePoint, IsAMinimumOnTheWayBack) {
  SmallProblem problem = testing::two_folds(2.0, 0.5);
  Follower path(problem);
  const auto at = [&](double a) {
    const double x = a - 2.0;
    const double lambda = x * x * x / 3.0 - 0.25 * x + 8.0 / 3.0 - 0.5;
    return point_of(path.solver.norm(), problem, Eigen::VectorXd::Constant(1, a), lambda,
                    Eigen::VectorXd::Ones(1), x * x - 0.25);
  };
  const LocatedEvents found = path.between(at(2.2), at(2.8), GetParam(), {kTolerance});
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].type, CriticalType::limit_min);
  // x = 1/2: 1/24 - 1/8 = -1/12 beside the start's 13/6
  EXPECT_NEAR(found.events[0].point.lambda, 13.0 / 6.0 - 1.0 / 12.0, kTolerance * 2.0);
  EXPECT_EQ(found.events[0].negative_before, 1);
  EXPECT_EQ(found.events[0].negative_after, 0);
}

TEST_P(SimplePoint, IsNotFoundWhereThereIsNone) {
  SmallProblem problem = pitchfork(0.6, 0.0);
  Follower path(problem);
  for (const auto& [from, to] : {std::pair(0.1, 0.59), std::pair(0.61, 0.99), std::pair(1.01, 1.5)}) {
    const LocatedEvents found = path.between(path.primary(from), path.primary(to), GetParam(), {kTolerance});
    EXPECT_TRUE(found.same_path);
    EXPECT_TRUE(found.events.empty()) << from;
    EXPECT_TRUE(found.touching.empty()) << from;
  }
}

/// Two limit points in the last third of a step, which the load's cubic through both ends does not show: it
/// falls at both ends and where the cubic turns.
TEST_P(SimplePoint, IsFoundBeforeAKnee) {
  for (const double width : {0.02, 0.01, 0.005}) {
    SCOPED_TRACE(width);
    SmallProblem problem = testing::knee(width);
    Follower path(problem);
    const auto at = [&](double a) {
      return point_of(path.solver.norm(), problem, Eigen::VectorXd::Constant(1, a),
                      testing::load_before_knee(a, width), Eigen::VectorXd::Ones(1),
                      testing::rate_before_knee(a, width));
    };
    const LocatedEvents found = path.between(at(0.01), at(1.0), GetParam(), {kTolerance});
    ASSERT_EQ(found.events.size(), 2U);
    EXPECT_EQ(found.events[0].type, CriticalType::limit_min);
    EXPECT_EQ(found.events[1].type, CriticalType::limit_max);
    for (const CriticalEvent& event : found.events)
      EXPECT_NEAR(testing::rate_before_knee(event.point.y[0], width), 0.0, 1e-4);
  }
}

/// A bifurcation and a limit point within one step, in the order in which they are met.
TEST_P(SimplePoint, IsSeparatedFromOthers) {
  for (const double c : {0.9, 0.99, 1.01, 1.1}) {
    SCOPED_TRACE(c);
    SmallProblem problem = pitchfork(c, 0.0);
    Follower path(problem);
    const LocatedEvents found = path.between(path.primary(0.8), path.primary(1.4), GetParam(), {kTolerance});
    ASSERT_EQ(found.events.size(), 2U);
    const std::size_t bifurcation = c < 1.0 ? 0 : 1;
    EXPECT_EQ(found.events[bifurcation].type, CriticalType::bifurcation);
    EXPECT_NEAR(found.events[bifurcation].point.lambda, c - 0.5 * c * c, kTolerance);
    EXPECT_EQ(found.events[1 - bifurcation].type, CriticalType::limit_max);
    EXPECT_NEAR(found.events[1 - bifurcation].point.lambda, 0.5, kTolerance);
    EXPECT_EQ(found.events[0].negative_after, 1);
    EXPECT_EQ(found.events[1].negative_before, 1);
    EXPECT_EQ(found.events[1].negative_after, 2);
  }
}

/// A bifurcation 1e-7 before the limit point, whose loads differ by 5e-15: one place, told as both.
TEST(Locate, TellsTwoPointsAtOnePlaceAsBoth) {
  SmallProblem problem = pitchfork(1.0 - 1e-7, 0.0);
  Follower path(problem);
  const LocatedEvents found = path.between(path.primary(0.8), path.primary(1.4), false, {kTolerance});
  ASSERT_TRUE(found.same_path);
  ASSERT_EQ(found.events.size(), 2U);
  int bifurcations = 0;
  for (const CriticalEvent& event : found.events) {
    EXPECT_NEAR(event.point.lambda, 0.5, kTolerance);
    bifurcations += event.type == CriticalType::bifurcation ? 1 : 0;
  }
  EXPECT_EQ(bifurcations, 1);
  EXPECT_EQ(found.events[0].negative_before, 0);
  EXPECT_EQ(found.events[0].negative_after, 1);
  EXPECT_EQ(found.events[1].negative_before, 1);
  EXPECT_EQ(found.events[1].negative_after, 2);
}

/// Load on a; b1 and b2 lose their stiffness c1 - a and c2 - a.
SmallProblem two_motions(double c1, double c2) {
  return {[=](const Eigen::VectorXd& y) {
            return Eigen::VectorXd(Eigen::Vector3d(
                y[0] - 0.5 * y[0] * y[0] - 0.5 * (y[1] * y[1] + y[2] * y[2]),
                (c1 - y[0]) * y[1] + y[1] * y[1] * y[1], (c2 - y[0]) * y[2] + y[2] * y[2] * y[2]));
          },
          [=](const Eigen::VectorXd& y) {
            Eigen::Matrix3d h;
            h << 1.0 - y[0], -y[1], -y[2], -y[1], c1 - y[0] + 3.0 * y[1] * y[1], 0.0, -y[2], 0.0,
                c2 - y[0] + 3.0 * y[2] * y[2];
            return Eigen::MatrixXd(h);
          },
          Eigen::Vector3d(1.0, 0.0, 0.0)};
}

LocatedEvents between_motions(double c1, double c2) {
  SmallProblem problem = two_motions(c1, c2);
  Follower path(problem);
  const auto at = [&](double a) {
    return point_of(path.solver.norm(), problem, Eigen::Vector3d(a, 0.0, 0.0), a - 0.5 * a * a,
                    Eigen::Vector3d(1.0, 0.0, 0.0), 1.0 - a);
  };
  return path.between(at(0.4), at(0.8), false, {kTolerance});
}

TEST(Locate, CountsWhatVanishesTogetherAsOnePointOfHigherMultiplicity) {
  const LocatedEvents found = between_motions(0.6, 0.6);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].type, CriticalType::bifurcation);
  EXPECT_EQ(found.events[0].multiplicity, 2);
  EXPECT_EQ(found.events[0].negative_before, 0);
  EXPECT_EQ(found.events[0].negative_after, 2);
  EXPECT_NEAR(found.events[0].point.lambda, 0.42, kTolerance);
  // apart by more than the tolerance they are two
  const LocatedEvents apart = between_motions(0.6, 0.6 + 1e-6);
  ASSERT_EQ(apart.events.size(), 2U);
  EXPECT_EQ(apart.events[0].multiplicity, 1);
  EXPECT_NEAR(apart.events[1].point.y[0] - apart.events[0].point.y[0], 1e-6, 1e-8);
}

/// f(a) = a up to 1, from there on down with half the slope, because a support ceases to act there.
SmallProblem corner(bool one_sided) {
  return {[](const Eigen::VectorXd& y) {
            return Eigen::VectorXd(Eigen::VectorXd::Constant(1, y[0] < 1.0 ? y[0] : 1.5 - 0.5 * y[0]));
          },
          [](const Eigen::VectorXd& y) {
            return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, y[0] < 1.0 ? 1.0 : -0.5));
          },
          Eigen::VectorXd::Ones(1), one_sided};
}

/// The stiffness jumps from 1 to -1/2 there: it does not pass zero.
TEST(Locate, KnowsALimitPointThatContactCauses) {
  for (const bool one_sided : {true, false}) {
    SmallProblem problem = corner(one_sided);
    PointSolver solver(problem, {});
    const SmallProblem::Gradient load = [](const Eigen::VectorXd& y) {
      return Eigen::VectorXd(Eigen::VectorXd::Constant(1, y[0] < 1.0 ? y[0] : 1.5 - 0.5 * y[0]));
    };
    const auto at = [&](double a) {
      const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, a);
      return point_of(solver.norm(), problem, y, load(y)[0], Eigen::VectorXd::Ones(1), a < 1.0 ? 1.0 : -0.5);
    };
    const LocatedEvents found = locate_critical_points(solver, at(0.7), at(1.2), {kTolerance});
    ASSERT_EQ(found.events.size(), 1U);
    EXPECT_EQ(found.events[0].type, CriticalType::limit_max);
    EXPECT_NEAR(found.events[0].point.lambda, 1.0, kTolerance);
    EXPECT_EQ(found.events[0].cause, one_sided ? CriticalCause::contact : CriticalCause::smooth);
  }
}

/// The stiffness jumps from 1 to -1e4 where contact changes at a = 1: the path goes on almost against its
/// tangent.
TEST(LocateAtTurn, PutsALimitPointAtTheCorner) {
  constexpr double kStiff = 1e4;
  const auto load = [](double a) { return a < 1.0 ? a : 1.0 - kStiff * (a - 1.0); };
  SmallProblem problem(
      [=](const Eigen::VectorXd& y) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, load(y[0]))); },
      [=](const Eigen::VectorXd& y) {
        return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, y[0] < 1.0 ? 1.0 : -kStiff));
      },
      Eigen::VectorXd::Ones(1), true);
  PathFollower follower(problem);
  const auto start = find_start(follower.solver()).point;
  ASSERT_TRUE(start);
  PathPoint from = *start;
  StepSize size{0.0, 0.1};
  PathPoint to;
  StepOutcome outcome = StepOutcome::advanced;
  for (int i = 0; i < 200 && outcome == StepOutcome::advanced && from.lambda < 1.1; ++i) {
    outcome = follower.step(from, size, to);
    if (outcome == StepOutcome::advanced) std::swap(from, to);
  }
  ASSERT_EQ(outcome, StepOutcome::kinked);
  const LocatedEvents found = locate_at_kink(follower, from, to, size.taken, {kTolerance});
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].type, CriticalType::limit_max);
  EXPECT_EQ(found.events[0].cause, CriticalCause::contact);
  EXPECT_NEAR(found.events[0].point.lambda, 1.0, 1e-6);
  EXPECT_EQ(found.events[0].negative_before, 0);
  EXPECT_EQ(found.events[0].negative_after, 1);
}

/// With an imperfection e the two arms a = c + b^2 - e / b never meet: from one to the other nothing is
/// located, and the step is called a jump. Where they come as near as rounding does (cube root of e) it is
/// whole.
TEST(Locate, SeesThatTheEndsAreOnTwoPaths) {
  constexpr double c = 0.6;
  for (const double e : {1e-3, 1e-6, 1e-17}) {
    SCOPED_TRACE(e);
    SmallProblem problem = pitchfork(c, e);
    Follower path(problem);
    const auto on_arm = [&](double b) {
      const double a = c + b * b - e / b;
      const double da = 2.0 * b + e / (b * b);
      return point_of(path.solver.norm(), problem, Eigen::Vector2d(a, b), a - 0.5 * a * a - 0.5 * b * b,
                      Eigen::Vector2d(da, 1.0), (1.0 - a) * da - b);
    };
    const double b = 10.0 * e;
    for (const bool modes : {false, true}) {
      const LocatedEvents found = path.between(on_arm(b), on_arm(-b), modes, {kTolerance});
      EXPECT_EQ(found.same_path, e < 1e-10) << modes;
      EXPECT_EQ(found.events.size(), e < 1e-10 ? 1U : 0U) << modes;
    }
  }
}

TEST(Locate, FindsNothingWhereNoPointBetweenConverges) {
  FailingProblem problem([] { return pitchfork(0.6, 0.0); }, {0.501, 0.699}, FailingProblem::How::no_number);
  Follower path(problem);
  const LocatedEvents found = path.between(path.primary(0.5), path.primary(0.7), false, {kTolerance});
  EXPECT_FALSE(found.same_path) << "the step has to be taken again, shorter";
  EXPECT_TRUE(found.events.empty());
}

TEST(Locate, LetsACancellationThrough) {
  FailingProblem problem([] { return pitchfork(0.6, 0.0); }, {0.501, 0.699}, FailingProblem::How::cancelled);
  Follower path(problem);
  EXPECT_THROW((void)path.between(path.primary(0.5), path.primary(0.7), false, {kTolerance}), Cancelled);
}

/// lambda = 0.32 at a = 0.4, which is neither end's.
TEST(FindRoot, ClosesTheBracketFromBothSides) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  Follower path(problem);
  const PathPoint a = path.primary(0.1);
  const PathPoint b = path.primary(0.9);
  const Segment segment(path.solver, a, b);
  const auto value = [](const PathPoint& at) { return at.lambda - 0.32; };
  int looks = 0;
  const auto counted = [&](const PathPoint& at) {
    ++looks;
    return value(at);
  };
  const auto done = [](const PathPoint& lo, const PathPoint& hi, double) {
    return hi.lambda - lo.lambda < 1e-10;
  };
  const LocatedRoot root = find_root(segment, value(a), value(b), {counted, done});
  ASSERT_TRUE(root.found);
  EXPECT_LT(root.value_before, 0.0);
  EXPECT_GT(root.value_after, 0.0);
  EXPECT_NEAR(root.root.y[0], 0.4, 1e-9);
  EXPECT_NEAR(root.before.lambda, 0.32, 1e-10);
  EXPECT_NEAR(root.after.lambda, 0.32, 1e-10);
  EXPECT_LT(looks, 15) << "a bisection would take 32";
  // a bracket that is never closed enough is not reported as found
  const auto never = [](const PathPoint&, const PathPoint&, double) { return false; };
  const auto off = [](const PathPoint& at) { return at.lambda > 0.32 ? 1.0 : -1.0; };
  EXPECT_FALSE(find_root(segment, -1.0, 1.0, {off, never}).found);
}

PathPoint with_mode(double stiffness, double rate) {
  PathPoint at;
  auto modes = std::make_shared<SoftModes>();
  modes->motions = Eigen::MatrixXd::Ones(1, 1);
  modes->stiffness = Eigen::VectorXd::Constant(1, stiffness);
  modes->rate = Eigen::VectorXd::Constant(1, rate);
  at.modes = modes;
  return at;
}

/// Tangents of a stiffness that meet below zero: 1 - 4 t and 1 - 4 (1 - t) at t = 1/2, at -1.
TEST(FindDip, SeesTangentsThatMeetBeyondZero) {
  const auto dip = find_dip(with_mode(1.0, -4.0), with_mode(1.0, 4.0), 1.0);
  ASSERT_TRUE(dip);
  EXPECT_DOUBLE_EQ(dip->fraction, 0.5);
  const auto uneven = find_dip(with_mode(1.0, -4.0), with_mode(2.0, 8.0), 1.0);
  ASSERT_TRUE(uneven);
  EXPECT_DOUBLE_EQ(uneven->fraction, 7.0 / 12.0);
  EXPECT_TRUE(find_dip(with_mode(-1.0, 4.0), with_mode(-1.0, -4.0), 1.0)) << "from below as well";
  EXPECT_FALSE(find_dip(with_mode(1.0, -1.9), with_mode(1.0, 1.9), 1.0)) << "they meet above zero";
  EXPECT_FALSE(find_dip(with_mode(1.0, 4.0), with_mode(1.0, -4.0), 1.0)) << "it rises first";
  EXPECT_FALSE(find_dip(with_mode(1.0, -4.0), with_mode(-1.0, -4.0), 1.0)) << "it passes zero once";
  EXPECT_FALSE(find_dip(PathPoint{}, with_mode(1.0, 4.0), 1.0)) << "nothing is known at one end";
}

}  // namespace
}  // namespace snapthrough
