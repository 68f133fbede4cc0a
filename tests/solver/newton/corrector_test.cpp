/// Newton's method on problems of one and two unknowns: each rule that ends it, and each way to fail.
#include "solver/newton/corrector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "solver/numeric/cancelled.h"
#include "tests/solver/newton/scalar_problem.h"
#include "tests/solver/path/small_problem.h"

namespace snapthrough {
namespace {

using testing::ScalarProblem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Nothing but the number of corrections ends it.
CorrectorOptions unbounded() {
  CorrectorOptions options;
  options.largest_correction = kInfinity;
  options.most_stalled = 100;
  return options;
}

struct Corrected {
  CorrectorOutcome outcome;
  double y = 0.0;
};

/// Corrects y at a given load.
Corrected correct_at(ScalarProblem& problem, double start, double lambda, double scale,
                     const CorrectorOptions& options) {
  const PathMetric metric{&problem.metric(), 0.0};
  Eigen::VectorXd y = Eigen::VectorXd::Constant(1, start);
  double load = lambda;
  Workspace work;
  Corrected out;
  out.outcome = correct(problem, metric, {}, scale, options, y, load, work);
  EXPECT_EQ(load, lambda) << "load control keeps the load";
  out.y = y[0];
  return out;
}

ScalarProblem square() {
  return {[](double y) { return y * y; }, [](double y) { return 2.0 * y; }};
}

/// stiffness * y, known to `noise` only: its sign changes with each evaluation, so that no correction helps.
ScalarProblem noisy(double stiffness, double noise) {
  const auto sign = std::make_shared<double>(1.0);
  return {[=](double y) {
            *sign = -*sign;
            return stiffness * y + *sign * noise;
          },
          [=](double) { return stiffness; }};
}

/// On a pinned plane: a + lambda = 1/2 and lambda = a - a^2/2 meet at a = 2 - sqrt(3).
TEST(Corrector, EndsOnThePathAndOnTheSideCondition) {
  testing::SmallProblem problem = testing::pitchfork(0.6, 0.0);
  const PathMetric metric{&problem.metric(), 1.0};
  const SideCondition side{Eigen::Vector2d(1.0, 0.0), 1.0};
  Eigen::VectorXd y = Eigen::Vector2d(0.3, 0.05);
  double lambda = 0.2;
  Workspace work;
  const CorrectorOutcome outcome = correct(problem, metric, side, 0.1, {}, y, lambda, work);
  ASSERT_EQ(outcome.status, CorrectorStatus::converged);
  EXPECT_NEAR(y[0], 2.0 - std::sqrt(3.0), 1e-13);
  EXPECT_NEAR(lambda, std::sqrt(3.0) - 1.5, 1e-13);
  EXPECT_NEAR(y[1], 0.0, 1e-13);
  EXPECT_EQ(outcome.tangent.negative, 0);
  // J^-1 load with the last factors, which the path's tangent is made of: (1 / (1 - a), 0)
  EXPECT_NEAR(work.load_response()[0], 1.0 / (std::sqrt(3.0) - 1.0), 1e-6);
}

/// 3, 2.17, 2.0064, 2.00001, 2 + 2.6e-11: the tolerance is met by the error that is left, and no correction
/// is made that it does not need.
TEST(Corrector, LeavesAnErrorBelowTheTolerance) {
  int last = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9, 1e-12}) {
    ScalarProblem problem = square();
    CorrectorOptions options;
    options.tolerance = tolerance;
    options.tangent_tolerance = 1e-300;  // without a look at what the last correction leaves
    options.largest_residual = 1.0;
    const Corrected at = correct_at(problem, 3.0, 4.0, 1.0, options);
    EXPECT_EQ(at.outcome.status, CorrectorStatus::converged) << tolerance;
    EXPECT_LE(std::abs(at.y - 2.0), tolerance) << tolerance;
    EXPECT_EQ(at.outcome.factorisations, problem.linearisations);
    EXPECT_GE(at.outcome.factorisations, last) << tolerance;
    last = at.outcome.factorisations;
  }
  EXPECT_LE(last, 6);
}

TEST(Corrector, ReportsThePredictorsError) {
  ScalarProblem problem = square();
  const Corrected at = correct_at(problem, 3.0, 4.0, 1.0, {});
  EXPECT_DOUBLE_EQ(at.outcome.first_correction, 5.0 / 6.0);
  EXPECT_DOUBLE_EQ(at.outcome.first_residual, 5.0);
}

/// For the tangent alone: the point is left at the square of the share, two corrections earlier.
TEST(Corrector, EndsWhereTheTangentIsGoodEnough) {
  CorrectorOptions options;
  options.tangent_tolerance = 1e-2;
  ScalarProblem problem = square();
  const Corrected rough = correct_at(problem, 3.0, 4.0, 1.0, options);
  ASSERT_EQ(rough.outcome.status, CorrectorStatus::converged);
  EXPECT_EQ(rough.outcome.factorisations, 3);
  EXPECT_LT(std::abs(rough.y - 2.0), 1e-4);
  EXPECT_GT(std::abs(rough.y - 2.0), 1e-9) << "it was iterated further than asked for";
}

/// A step that is mostly load: the tolerance is a share of the movement in it.
TEST(Corrector, MeasuresByTheMovementWhereThatIsLessThanTheStep) {
  CorrectorOptions options;
  options.tolerance = 1e-3;
  options.tangent_tolerance = 1e-300;
  options.largest_residual = 1.0;
  ScalarProblem problem = square();
  const Corrected by_step = correct_at(problem, 3.0, 4.0, 100.0, options);
  options.displacement = 1e-4;
  const Corrected by_movement = correct_at(problem, 3.0, 4.0, 100.0, options);
  EXPECT_LE(std::abs(by_step.y - 2.0), 0.1);
  EXPECT_GT(std::abs(by_step.y - 2.0), 1e-7);
  EXPECT_LE(std::abs(by_movement.y - 2.0), 1e-7);
}

/// A linear problem is solved by its first correction; the second look finds rounding and nothing to predict.
TEST(Corrector, EndsAtTheResidualThatRoundingAllows) {
  ScalarProblem problem([](double y) { return 3.0 * y; }, [](double) { return 3.0; });
  const Corrected at = correct_at(problem, 0.0, 1.0, 0.1, unbounded());
  EXPECT_EQ(at.outcome.status, CorrectorStatus::converged);
  EXPECT_EQ(at.outcome.factorisations, 2);
  EXPECT_DOUBLE_EQ(at.y, 1.0 / 3.0);
}

/// Beside a singular point a residual of rounding makes a correction of any size: the point stays.
TEST(Corrector, LeavesAnExactPointWhereTheTangentIsNearlySingular) {
  ScalarProblem problem([](double y) { return 1e-20 * (y - 1.0) + 1e-16; }, [](double) { return 1e-20; });
  const Corrected at = correct_at(problem, 1.0, 0.0, 0.1, {});
  EXPECT_EQ(at.outcome.status, CorrectorStatus::converged);
  EXPECT_EQ(at.outcome.factorisations, 1);
  EXPECT_EQ(at.y, 1.0);
  EXPECT_NEAR(at.outcome.first_correction, 1e4, 1.0);
}

/// A residual that no longer falls is rounding's below `stagnant_residual`, and a failure above it. The
/// tolerance, 1e-13 here, is below both.
TEST(Corrector, TakesAStagnantResidualForRoundingIfItIsSmall) {
  ScalarProblem below = noisy(1.0, 4e-12);
  const Corrected converged = correct_at(below, 0.0, 0.0, 1e-4, {});
  EXPECT_EQ(converged.outcome.status, CorrectorStatus::converged);
  EXPECT_EQ(converged.outcome.factorisations, 5) << "the first four corrections may still help";
  ScalarProblem above = noisy(1.0, 4e-11);
  EXPECT_EQ(correct_at(above, 0.0, 0.0, 1e-4, {}).outcome.status, CorrectorStatus::too_many_iterations);
}

/// What stiff supports' forces leave is known to the problem: then it is no failure.
TEST(Corrector, SettlesAtTheRoundingOfStiffSupports) {
  ScalarProblem problem = noisy(1.0, 4e-11);
  problem.rounding = 1e-10;
  const Corrected at = correct_at(problem, 0.0, 0.0, 1e-4, {});
  EXPECT_EQ(at.outcome.status, CorrectorStatus::converged);
  EXPECT_NEAR(at.outcome.relative_residual, 8e-11, 1e-14);
}

/// Newton's method on y^3 - 2 y + 2 goes from 0 to 1 and back for ever.
TEST(Corrector, GivesUpACycle) {
  ScalarProblem problem([](double y) { return y * y * y - 2.0 * y + 2.0; },
                        [](double y) { return 3.0 * y * y - 2.0; });
  const Corrected at = correct_at(problem, 0.0, 0.0, 1.0, {});
  EXPECT_EQ(at.outcome.status, CorrectorStatus::too_many_iterations);
  EXPECT_EQ(at.outcome.factorisations, 5) << "one, and one more than most_stalled that are no better";
}

TEST(Corrector, GivesUpAfterItsLastIteration) {
  ScalarProblem problem = square();
  CorrectorOptions options = unbounded();
  options.max_iterations = 4;
  const Corrected at = correct_at(problem, 1e6, 4.0, 1.0, options);
  EXPECT_EQ(at.outcome.status, CorrectorStatus::too_many_iterations);
  EXPECT_EQ(at.outcome.factorisations, 4);
  options.max_iterations = 40;
  EXPECT_EQ(correct_at(problem, 1e6, 4.0, 1.0, options).outcome.status, CorrectorStatus::converged);
}

TEST(Corrector, IsDivergedWhereTheTangentIsSingular) {
  ScalarProblem problem = square();
  const Corrected at = correct_at(problem, 0.0, 4.0, 1.0, unbounded());
  EXPECT_EQ(at.outcome.status, CorrectorStatus::diverged);
  EXPECT_EQ(at.outcome.factorisations, 1);
  EXPECT_EQ(at.y, 0.0) << "nothing was taken";
}

TEST(Corrector, IsDivergedWhereTheResidualIsNoNumber) {
  ScalarProblem problem([](double y) { return std::log(y); }, [](double y) { return 1.0 / y; });
  // 3 - 3 log 3 is negative
  const Corrected at = correct_at(problem, 3.0, 0.0, 1.0, unbounded());
  EXPECT_EQ(at.outcome.status, CorrectorStatus::diverged);
  EXPECT_EQ(at.outcome.factorisations, 2);
}

/// Of atan y from beyond 1.39: corrections grow. Each bound ends it where it is first exceeded.
TEST(Corrector, IsDivergedWhereCorrectionsAreTooLarge) {
  ScalarProblem problem([](double y) { return std::atan(y); }, [](double y) { return 1.0 / (1.0 + y * y); });
  const double first = 3.25 * std::atan(1.5);
  CorrectorOptions options = unbounded();
  options.largest_first = 0.99 * first;
  const Corrected hopeless = correct_at(problem, 1.5, 0.0, 1.0, options);
  EXPECT_EQ(hopeless.outcome.status, CorrectorStatus::diverged);
  EXPECT_EQ(hopeless.outcome.factorisations, 1);
  EXPECT_EQ(hopeless.y, 1.5) << "a hopeless correction is not taken";

  options = unbounded();
  options.largest_correction = 0.99 * first;
  EXPECT_EQ(correct_at(problem, 1.5, 0.0, 1.0, options).outcome.factorisations, 1);

  options = unbounded();
  options.largest_growth = 1.2;  // the second correction is 1.26 times the first
  EXPECT_EQ(correct_at(problem, 1.5, 0.0, 1.0, options).outcome.factorisations, 2);
  options.largest_growth = 1.3;
  EXPECT_GT(correct_at(problem, 1.5, 0.0, 1.0, options).outcome.factorisations, 2);
  for (const double start : {1.0, 1.5})
    EXPECT_EQ(correct_at(problem, start, 0.0, 1.0, unbounded()).outcome.status == CorrectorStatus::converged,
              start < 1.39)
        << start;
}

/// Whoever asked to stop is heard in the middle of the iteration.
TEST(Corrector, LetsACancellationThrough) {
  ScalarProblem problem = square();
  problem.before = [](int number) {
    if (number == 3) throw Cancelled{};
  };
  EXPECT_THROW((void)correct_at(problem, 3.0, 4.0, 1.0, {}), Cancelled);
  EXPECT_EQ(problem.linearisations, 3);
}

/// A spring of 1e6 from y = 1 on, beside one of 1. The first correction is as small as the tangent asks for,
/// but it crosses to where the factors say nothing.
TEST(Corrector, DoesNotEndWithACorrectionIntoOtherContact) {
  constexpr double kStiff = 1e6;
  ScalarProblem problem([](double y) { return y + kStiff * std::max(y - 1.0, 0.0); },
                        [](double y) { return y > 1.0 ? 1.0 + kStiff : 1.0; });
  CorrectorOptions options;
  options.tangent_tolerance = 1e-2;
  const double exact = 1.0 + 1e-3 / (1.0 + kStiff);
  problem.kind.one_sided = true;
  EXPECT_NEAR(correct_at(problem, 0.999, 1.001, 1.0, options).y, exact, 1e-12);
  problem.kind.one_sided = false;  // a smooth problem would have been let go
  EXPECT_NEAR(correct_at(problem, 0.999, 1.001, 1.0, options).y, 1.001, 1e-12);
}

/// Stiff between two places and soft beyond: Newton's method jumps to and fro. The energy is convex, and has
/// its least at 0.
TEST(Corrector, FollowsTheEnergyDownhillWhereContactCycles) {
  constexpr double kStiff = 100.0;
  ScalarProblem problem([](double y) { return y + kStiff * std::clamp(y, -1.0, 1.0); },
                        [](double y) { return std::abs(y) < 1.0 ? 1.0 + kStiff : 1.0; });
  problem.kind.one_sided = true;
  EXPECT_EQ(correct_at(problem, 2.0, 0.0, 1.0, unbounded()).outcome.status,
            CorrectorStatus::too_many_iterations);
  const Corrected at = correct_at(problem, 2.0, 0.0, 1.0, downhill({}, 12));
  EXPECT_EQ(at.outcome.status, CorrectorStatus::converged);
  EXPECT_NEAR(at.y, 0.0, 1e-12);
}

}  // namespace
}  // namespace snapthrough
