/// Rates of monitors at bifurcations against differences of the path and a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "api/api.h"
#include "solver/solve.h"

namespace snapthrough {
namespace {

api::Request example(const std::string& name) {
  std::ifstream file(SNAPTHROUGH_SOURCE_DIR "/examples/" + name);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  api::ReadOutcome outcome = api::read_request(text);
  EXPECT_TRUE(outcome.request) << name;
  // the point is that of the path's mesh
  outcome.request->analysis.discretization.fixed_mesh = true;
  outcome.request->analysis.discretization.elements = 12;
  outcome.request->analysis.discretization.order = 4;
  return *outcome.request;
}

/// Height of the middle of the first member in the state at a load factor that is nearest to `crown`.
double crown_at(const Result& result, double load_factor, double crown) {
  double nearest = 1e300;
  for (const State& state : result.states) {
    const std::vector<double>& v = state.members.front().v;
    const double middle = v[v.size() / 2];
    if (std::abs(state.load_factor - load_factor) < 1e-9 * std::abs(load_factor) &&
        std::abs(middle - crown) < std::abs(nearest - crown))
      nearest = middle;
  }
  return nearest;
}

const CriticalPoint& first_bifurcation(const Result& result) {
  for (const CriticalPoint& point : result.critical_points)
    if (point.type == CriticalType::bifurcation) return point;
  static const CriticalPoint none;
  ADD_FAILURE() << "no bifurcation: " << result.summary.message;
  return none;
}

/// The path is cut at load factors on both sides of the bifurcation, where states are in equilibrium.
void expect_rate_of_differences(const std::string& name) {
  SCOPED_TRACE(name);
  api::Request request = example(name);
  const CriticalPoint point = first_bifurcation(solve(request.model, request.analysis));
  ASSERT_EQ(point.monitor_rate.size(), 1U);
  EXPECT_EQ(point.monitor_rate[0].id, "crown");
  const double step = 1e-4 * std::abs(point.load_factor);
  request.analysis.output.states = StateOutput::at_load_factors;
  request.analysis.output.at_load_factors = {point.load_factor - step, point.load_factor + step};
  const Result result = solve(request.model, request.analysis);
  const double crown = point.monitors[0].value;
  const double rate = (crown_at(result, point.load_factor + step, crown) -
                       crown_at(result, point.load_factor - step, crown)) /
                      (2.0 * step);
  EXPECT_NEAR(point.monitor_rate[0].value, rate, 1e-6 * std::abs(rate));  // the difference: 1.1e-7
}

TEST(MonitorRate, IsThatOfThePathsDifferences) {
  expect_rate_of_differences("arch_no_base.json");  // on the way up
  expect_rate_of_differences("tunnel_arch.json");   // beyond the limit point, on the way down
}

/// A straight film is shortened by P L / EA until it wrinkles.
TEST(MonitorRate, OfAStraightMemberIsItsFlexibility) {
  const api::Request request = example("film_on_substrate.json");
  const CriticalPoint point = first_bifurcation(solve(request.model, request.analysis));
  ASSERT_EQ(point.monitor_rate.size(), 1U);
  EXPECT_NEAR(point.monitor_rate[0].value, -10.0 * 12.0 / 1e5, 1e-10);
}

TEST(MonitorRate, IsAbsentAtLimitPoints) {
  const api::Request request = example("tunnel_arch.json");
  int limits = 0;
  for (const CriticalPoint& point : solve(request.model, request.analysis).critical_points) {
    if (!is_limit(point.type)) continue;
    ++limits;
    EXPECT_TRUE(point.monitor_rate.empty()) << point.load_factor;
  }
  EXPECT_GE(limits, 2);
}

}  // namespace
}  // namespace snapthrough
