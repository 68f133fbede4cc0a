/// Requests for curves of critical points, and what they refuse. Values: tests/verification.

#include "solver/sweep/critical_locus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <stop_token>
#include <vector>

#include "solver/solve.h"
#include "tests/solver/sweep/arches.h"

namespace snapthrough {
namespace {

using namespace testing;

Model arch_of_angle(double degrees) {
  Model model = one_arch(0.01);
  model.members[0].curve = ArcCurve{-degrees};
  return model;
}

/// The medium below the arch presses where the arch sinks into it, and does not pull.
Model arch_on_medium(double k) {
  Model model = one_arch(k);
  model.foundations[0].reaction = Reaction::compression_only;
  model.foundations[0].side = Side::right;
  return model;
}

CriticalLocusRequest request() {
  CriticalLocusRequest out;
  out.model = one_arch;
  out.analysis.type = AnalysisType::critical;
  out.analysis.discretization.elements = 8;
  out.analysis.discretization.order = 4;
  out.analysis.discretization.fixed_mesh = true;
  out.logarithmic = true;
  out.values = {1e-3, 2e-3, 5e-3, 0.01, 0.02};
  return out;
}

TEST(CriticalLocus, FirstPointIsThatOfTheTracedPaths) {
  CriticalLocusRequest asked = request();
  asked.number = 0;
  const CriticalLocus locus = follow_critical_locus(asked);
  ASSERT_EQ(locus.curves.size(), 1U);
  ASSERT_EQ(locus.curves[0].loads.size(), asked.values.size());
  EXPECT_EQ(locus.curves[0].end, LocusEnd::last_value);
  for (const LocusLoad& load : locus.curves[0].loads) {
    const Result traced = solve(one_arch(asked.values[load.value]), asked.analysis);
    // both are located to 1e-9 of the load
    EXPECT_NEAR(load.load_factor / *traced.summary.critical_load_factor, 1.0, 2e-9);
    EXPECT_EQ(load.type, *traced.summary.critical_type);
  }
}

void expect_first_of_traced_paths(CriticalLocusRequest asked) {
  asked.number = 0;
  const CriticalLocus locus = follow_critical_locus(asked);
  ASSERT_EQ(locus.curves.size(), 1U);
  ASSERT_EQ(locus.curves[0].loads.size(), asked.values.size());
  for (const LocusLoad& load : locus.curves[0].loads) {
    const Result traced = solve(asked.model(asked.values[load.value]), asked.analysis);
    EXPECT_NEAR(load.load_factor / *traced.summary.critical_load_factor, 1.0, 2e-9)
        << asked.values[load.value];
  }
}

TEST(CriticalLocus, FollowsAChangeOfShape) {
  CriticalLocusRequest asked = request();
  asked.model = arch_of_angle;
  asked.logarithmic = false;
  asked.values = {50.0, 55.0, 60.0, 65.0, 70.0};
  expect_first_of_traced_paths(asked);
}

TEST(CriticalLocus, FollowsAnArchOnAOneSidedMedium) {
  CriticalLocusRequest asked = request();
  asked.model = arch_on_medium;
  expect_first_of_traced_paths(asked);
}

TEST(CriticalLocus, SecondPointIsAnotherCurve) {
  CriticalLocusRequest asked = request();
  asked.number = 1;
  const CriticalLocus locus = follow_critical_locus(asked);
  ASSERT_EQ(locus.curves.size(), 1U);
  EXPECT_EQ(locus.curves[0].loads.front().type, CriticalType::limit_min);
}

TEST(CriticalLocus, FallingValuesGiveTheSameLoads) {
  CriticalLocusRequest asked = request();
  const CriticalLocus up = follow_critical_locus(asked);
  std::reverse(asked.values.begin(), asked.values.end());
  const CriticalLocus down = follow_critical_locus(asked);
  const auto loads = [&](const CriticalLocus& locus, std::size_t value) {
    std::vector<double> out;
    for (const LocusCurve& curve : locus.curves)
      for (const LocusLoad& load : curve.loads)
        if (load.value == value) out.push_back(load.load_factor);
    std::sort(out.begin(), out.end());
    return out;
  };
  for (std::size_t i = 0; i < asked.values.size(); ++i) {
    const auto a = loads(up, i);
    const auto b = loads(down, asked.values.size() - 1 - i);
    ASSERT_EQ(a.size(), b.size()) << i;
    for (std::size_t j = 0; j < a.size(); ++j) EXPECT_NEAR(a[j], b[j], 2e-9 * std::abs(a[j]));
  }
}

/// Limit points that only values between the first and the last one have lie on a closed curve, which is not
/// found.
TEST(CriticalLocus, SaysWhereAPointLiesOnNoCurve) {
  CriticalLocusRequest asked = request();
  asked.model = [](double t) { return pinned_shallow_arch(200.0 + 100.0 * t * t); };
  asked.logarithmic = false;
  asked.values = {-1.0, 0.0, 1.0};
  const CriticalLocus locus = follow_critical_locus(asked);
  EXPECT_EQ(locus.failure, "");
  EXPECT_TRUE(locus.none_up_to[0] && !locus.none_up_to[1] && locus.none_up_to[2]);
  ASSERT_EQ(locus.curves.size(), 1U);
  EXPECT_TRUE(locus.curves[0].loads.empty());
  ASSERT_EQ(locus.curves[0].events.size(), 1U);
  const LocusEvent& event = locus.curves[0].events[0];
  EXPECT_EQ(event.type, LocusEventType::not_followed);
  EXPECT_EQ(event.value, 0.0);
  const Result traced = solve(asked.model(0.0), asked.analysis);
  EXPECT_NEAR(event.load_factor / *traced.summary.critical_load_factor, 1.0, 2e-9);
}

TEST(CriticalLocus, RefusesWhatItCannotFollow) {
  CriticalLocusRequest asked = request();
  asked.values = {1.0};
  EXPECT_THROW(static_cast<void>(follow_critical_locus(asked)), std::invalid_argument);
  asked = request();
  asked.values = {1.0, 3.0, 2.0};
  EXPECT_THROW(static_cast<void>(follow_critical_locus(asked)), std::invalid_argument);
  asked = request();
  asked.values.front() = -1.0;
  EXPECT_THROW(static_cast<void>(follow_critical_locus(asked)), std::invalid_argument);
  asked = request();
  asked.analysis.discretization.fixed_mesh = false;
  EXPECT_THROW(static_cast<void>(follow_critical_locus(asked)), std::invalid_argument);
}

TEST(CriticalLocus, EndsWhenItIsAskedTo) {
  std::stop_source source;
  source.request_stop();
  CriticalLocusRequest asked = request();
  asked.stop = source.get_token();
  EXPECT_EQ(follow_critical_locus(asked).failure, "cancelled");
}

}  // namespace
}  // namespace snapthrough
