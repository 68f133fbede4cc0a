/// Critical points from the softest motions of one point, or from one that is known from elsewhere.
#include "solver/events/newton_event.h"

#include <gtest/gtest.h>

#include "solver/events/branch.h"
#include "solver/events/critical_mode.h"
#include "tests/solver/path/small_problem.h"

namespace snapthrough {
namespace {

using testing::pitchfork;
using testing::SmallProblem;

/// The pitchfork's primary path at a = 0.5, whose motion b loses its stiffness 0.1 at a = 0.6.
struct Before {
  explicit Before(double imperfection = 0.0)
      : problem(pitchfork(0.6, imperfection)), follower(problem), at(*find_start(follower.solver()).point) {
    at.y = Eigen::Vector2d(0.5, 0.0);
    at.lambda = 0.375;
    const double norm = follower.norm().metric().norm(Eigen::Vector2d(1.0, 0.0), 0.5);
    at.tangent = Eigen::Vector2d(1.0 / norm, 0.0);
    at.tangent_lambda = 0.5 / norm;
    at.arc_length = 0.7;
    Eigen::VectorXd f;
    at.negative = problem.linearise(at.y, at.lambda, f).negative;
    follower.solver().find_modes(at, nullptr);
  }
  SmallProblem problem;
  PathFollower follower;
  PathPoint at;
};

/// The mode b is the softest: stiffness 0.1, which falls by da/ds along the path.
TEST(BifurcationsBeyond, FindTheOneThatTheSoftestMotionPromises) {
  Before from;
  ASSERT_TRUE(from.at.modes);
  EXPECT_NEAR(from.at.modes->stiffness[0], 0.1, 1e-9);
  EXPECT_NEAR(from.at.modes->rate[0], -from.at.tangent[0], 1e-6);
  const double distance = from.at.modes->distance_to_zero(0, 1.0);
  EXPECT_NEAR(distance, 0.1 / from.at.tangent[0], 1e-6);
  const auto found = bifurcations_beyond(from.follower.solver(), from.at, {0}, distance, distance, 1e-9);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].point.lambda, 0.42, 1e-9);
  EXPECT_EQ(found[0].negative_before, 0);
  EXPECT_EQ(found[0].negative_after, 1);
  EXPECT_GT(found[0].point.arc_length, 0.7);
  EXPECT_GT(found[0].point.tangent[0], 0.0);
  ASSERT_EQ(found[0].across.size(), 2);
  EXPECT_NEAR(std::abs(found[0].across[1]), 1.0, 1e-6) << "the path that crosses goes along b";
  // one that lies behind is not beyond, and one out of reach is not found
  EXPECT_TRUE(bifurcations_beyond(from.follower.solver(), from.at, {0}, -distance, 0.01, 1e-9).empty());
  EXPECT_TRUE(bifurcations_beyond(from.follower.solver(), from.at, {0}, 3.0 * distance, 0.01, 1e-9).empty());
}

/// A point that is known roughly, as from a coarser mesh.
TEST(CriticalPointNear, IsTheKnownOneHere) {
  Before from;
  CriticalEvent known;
  known.type = CriticalType::bifurcation;
  known.negative_before = 0;
  known.negative_after = 1;
  PathPoint guess = from.at;
  guess.y = Eigen::Vector2d(0.59, 0.0);
  guess.lambda = 0.41;
  const Eigen::MatrixXd null = Eigen::Vector2d(0.1, 1.0).normalized();
  const auto found = critical_point_near(from.follower.solver(), known, guess, null, 0.1, 1e-9);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->point.lambda, 0.42, 1e-9);
  // nor with another inertia, nor where contact is the cause, nor farther away than it may be
  CriticalEvent other = known;
  other.negative_before = 1;
  other.negative_after = 2;
  EXPECT_FALSE(critical_point_near(from.follower.solver(), other, guess, null, 0.1, 1e-9));
  other = known;
  other.cause = CriticalCause::contact;
  EXPECT_FALSE(critical_point_near(from.follower.solver(), other, guess, null, 0.1, 1e-9));
  EXPECT_FALSE(critical_point_near(from.follower.solver(), known, guess, null, 1e-3, 1e-9));
}

TEST(CriticalMode, IsTheMotionWithoutStiffness) {
  Before from;
  CriticalEvent event;
  event.type = CriticalType::bifurcation;
  event.point = from.at;
  event.point.y = Eigen::Vector2d(0.6 - 1e-9, 0.0);
  event.point.lambda = 0.42;
  Eigen::VectorXd mode = mode_of(from.problem, event);
  EXPECT_NEAR(std::abs(mode[1]), 1.0, 1e-9);
  EXPECT_NEAR(mode[0], 0.0, 1e-6);
  // where contact turns the load, no motion is without stiffness: the path's own direction
  event.type = CriticalType::limit_max;
  event.cause = CriticalCause::contact;
  event.point.tangent = Eigen::Vector2d(0.3, 0.4);
  EXPECT_EQ(mode_of(from.problem, event), event.point.tangent);
  mode = null_vector(from.problem, from.at, Eigen::Vector2d(1.0, 1.0));
  EXPECT_NEAR(std::abs(mode[1]), 1.0, 1e-9) << "the softest of 0.5 and 0.1";
}

/// Without the direction that crosses, it is found from the null vector; at no singular point there is none.
TEST(Branch, IsFoundWithoutItsDirection) {
  Before from;
  CriticalEvent event;
  event.point = from.at;
  event.point.y = Eigen::Vector2d(0.6, 0.0);
  event.point.lambda = 0.42;
  for (const double sign : {1.0, -1.0}) {
    const auto first = first_point_of_branch(from.follower, event, sign);
    ASSERT_TRUE(first);
    const double b = first->y[1];
    EXPECT_GT(sign * b, 1e-3);
    EXPECT_NEAR(first->y[0], 0.6 + b * b, 1e-9) << "on the other path";
  }
}

}  // namespace
}  // namespace snapthrough
