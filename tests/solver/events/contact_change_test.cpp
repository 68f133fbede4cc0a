/// Where contact begins and ends between two points of a path, on a path in closed form.
#include "solver/events/contact_change.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/path/path_start.h"
#include "tests/solver/path/small_problem.h"

namespace snapthrough {
namespace {

using testing::pitchfork;
using testing::SmallProblem;

constexpr double kTolerance = 1e-7;  // far above what the corrector leaves of a step

/// Changes along lambda = a - a^2/2 from one a to another.
std::vector<ContactChange> changes(double from, double to, const ZoneCounter& count) {
  SmallProblem problem = pitchfork(5.0, 0.0);
  PointSolver solver(problem, {});
  const auto start = find_start(solver).point;
  EXPECT_TRUE(start);
  const auto at = [&](double a) {
    PathPoint point = *start;
    point.y = Eigen::Vector2d(a, 0.0);
    point.lambda = a - 0.5 * a * a;
    point.arc_length = a;
    point.tangent = Eigen::Vector2d(1.0, 0.0);
    const double norm = solver.norm().metric().norm(point.tangent, 1.0 - a);
    point.tangent /= norm;
    point.tangent_lambda = (1.0 - a) / norm;
    return point;
  };
  return locate_contact_changes(solver, at(from), at(to), false, count, kTolerance);
}

TEST(ContactChange, IsWhereTheCountsAreOthers) {
  const auto count = [](const Eigen::VectorXd& y, std::vector<int>& zones) {
    zones = {y[0] > 0.4 ? 1 : 0, 3};
  };
  const auto found = changes(0.1, 0.9, count);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].before, (std::vector<int>{0, 3}));
  EXPECT_EQ(found[0].after, (std::vector<int>{1, 3}));
  EXPECT_NEAR(found[0].point.lambda, 0.32, kTolerance * 0.32);
  EXPECT_GT(found[0].point.y[0], 0.4) << "the point is one where it has changed";
}

/// Of two supports, and of one that divides and joins again: in the order of the path.
TEST(ContactChange, OfSeveralOnOneStepAreToldInOrder) {
  const auto count = [](const Eigen::VectorXd& y, std::vector<int>& zones) {
    zones = {y[0] > 0.2 && y[0] < 0.7 ? 2 : 1, y[0] > 0.5 ? 1 : 0};
  };
  const auto found = changes(0.1, 0.9, count);
  ASSERT_EQ(found.size(), 3U);
  const double places[] = {0.2, 0.5, 0.7};
  for (std::size_t i = 0; i < 3; ++i) {
    const double lambda = places[i] - 0.5 * places[i] * places[i];
    EXPECT_NEAR(found[i].point.lambda, lambda, 2.0 * kTolerance * lambda) << i;
    EXPECT_EQ(found[i].before, i > 0 ? found[i - 1].after : (std::vector<int>{1, 0}));
  }
  EXPECT_EQ(found[2].after, (std::vector<int>{1, 1}));
}

/// Everything touches at once where the load begins: that is told at the start, not after it.
TEST(ContactChange, AtTheStartOfAStepIsThere) {
  const auto count = [](const Eigen::VectorXd& y, std::vector<int>& zones) {
    zones = {y[0] > 0.1 ? 1 : 0, y[0] > 0.4 ? 1 : 0};
  };
  const auto found = changes(0.1, 0.9, count);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_DOUBLE_EQ(found[0].point.y[0], 0.1);
  EXPECT_EQ(found[0].after, (std::vector<int>{1, 0}));
  EXPECT_NEAR(found[1].point.lambda, 0.32, kTolerance);
}

TEST(ContactChange, IsNoneWhereCountsStay) {
  const auto count = [](const Eigen::VectorXd&, std::vector<int>& zones) { zones = {1, 2}; };
  EXPECT_TRUE(changes(0.1, 0.9, count).empty());
}

}  // namespace
}  // namespace snapthrough
