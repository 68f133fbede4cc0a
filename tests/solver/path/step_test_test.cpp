/// The step test: each threshold by itself, the factor to the next size, and when a failing step is a kink.
#include "solver/path/step_test.h"

#include <gtest/gtest.h>

namespace snapthrough {
namespace {

/// Measures of a step on a smooth path, well within all limits.
StepMeasures smooth() {
  StepMeasures measures;
  measures.converged = true;
  measures.angle = 0.1;
  measures.correction = 0.01;
  measures.corrections = 2;
  return measures;
}

StepVerdict verdict(const StepMeasures& measures, double size = 1.0, bool may_kink = true) {
  return judge_step(measures, {}, {size, 1.0}, may_kink).verdict;
}

TEST(StepTest, AcceptsASmoothStep) { EXPECT_EQ(verdict(smooth()), StepVerdict::accepted); }

/// Beyond any one of the thresholds a step is too long.
TEST(StepTest, RejectsByEachThreshold) {
  const StepLimits limits;
  StepMeasures failed = smooth();
  failed.converged = false;
  EXPECT_EQ(verdict(failed), StepVerdict::too_long);
  const auto rejects = [](double StepMeasures::*measure, double most) {
    StepMeasures within = smooth();
    within.*measure = most;
    StepMeasures beyond = smooth();
    beyond.*measure = 1.001 * most;
    return verdict(within) == StepVerdict::accepted && verdict(beyond) == StepVerdict::too_long;
  };
  EXPECT_TRUE(rejects(&StepMeasures::angle, limits.max_angle));
  EXPECT_TRUE(rejects(&StepMeasures::correction, limits.max_correction));
  EXPECT_TRUE(rejects(&StepMeasures::tangent_mismatch, limits.max_tangent_mismatch));
  EXPECT_TRUE(rejects(&StepMeasures::missed_contact, limits.max_missed_contact));
}

/// Where zones of contact begin, end or meet the path may turn back, and another path may be near.
TEST(StepTest, AllowsSmallerAnglesWhereContactZonesChange) {
  StepMeasures measures = smooth();
  measures.angle = 0.5;
  EXPECT_EQ(verdict(measures), StepVerdict::accepted);
  measures.contact_zones_change = true;
  EXPECT_EQ(verdict(measures), StepVerdict::too_long);
}

/// The next size brings the measure that is farthest from its target to it: the angle and the first
/// correction grow with the step, the error of the forecast with its cube.
TEST(StepTest, ScalesTheNextStepByTheTightestTarget) {
  const StepLimits limits;
  const auto factor = [&](const StepMeasures& measures) {
    return judge_step(measures, limits, {1.0, 1.0}, true).factor;
  };
  EXPECT_EQ(factor(smooth()), limits.max_growth);
  StepMeasures measures = smooth();
  measures.angle = 0.6;
  EXPECT_DOUBLE_EQ(factor(measures), 0.5);
  measures.correction = 0.2;
  EXPECT_DOUBLE_EQ(factor(measures), 0.4);
  measures = smooth();
  measures.missed_contact = 8.0 * limits.target_missed_contact;
  EXPECT_EQ(verdict(measures), StepVerdict::too_long);
  EXPECT_DOUBLE_EQ(factor(measures), 0.5);
  measures.angle = 100.0;
  EXPECT_EQ(factor(measures), limits.min_growth);
}

/// A rejected step is shortened by half at least, one without equilibrium by the smallest factor.
TEST(StepTest, ShortensARejectedStep) {
  const StepLimits limits;
  StepMeasures measures = smooth();
  measures.tangent_mismatch = 1.0;
  EXPECT_EQ(judge_step(measures, limits, {1.0, 1.0}, true).factor, limits.max_shortening);
  measures.converged = false;
  EXPECT_EQ(judge_step(measures, limits, {1.0, 1.0}, true).factor, limits.min_growth);
}

/// A step that fails at a thousandth of the last full step meets a kink, if supports act on one side only,
/// and unless it is a smooth turn that a shorter step will follow.
TEST(StepTest, TakesAStepThatFailsWhenTinyForAKink) {
  StepMeasures failed;
  EXPECT_EQ(verdict(failed, 1e-2), StepVerdict::too_long);
  EXPECT_EQ(verdict(failed, 1e-3), StepVerdict::kink) << "0.3 of it is below a thousandth";
  EXPECT_EQ(verdict(failed, 1e-3, false), StepVerdict::too_long);
  StepMeasures turns = smooth();
  turns.tangent_mismatch = 1.0;
  EXPECT_EQ(verdict(turns, 1e-4), StepVerdict::too_long);
  turns.angle = 2.0;
  EXPECT_EQ(verdict(turns, 1e-4), StepVerdict::kink);
}

}  // namespace
}  // namespace snapthrough
