/// Compiled with the blocks of docs/howto/add-a-foundation-law.md; see law.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "api/api.h"
#include "solver/solve.h"

namespace snapthrough {
namespace {

/// An upright bar of length 1, almost rigid, on a hinge with the new law in rotation (k = 10, P = 1).
constexpr const char* kRequest = R"({
  "model": {
    "nodes": [{"id": "foot", "x": 0, "y": 0}, {"id": "head", "x": 0, "y": 1}],
    "sections": [{"id": "bar", "EA": 1e13, "EI": 1e11}],
    "members": [{"id": "bar", "start": "foot", "end": "head", "section": "bar"}],
    "supports": [{"node": "foot", "fixed": ["x", "y"]}],
    "springs": [{"id": "hinge", "at": {"node": "foot"}, "direction": "rotation",
                 "law": {"type": "algebraic", "stiffness": 10, "capacity": 1}}],
    "loads": [{"type": "point", "at": {"node": "head"}, "force": [0.05, -1]}]
  },
  "analysis": {"type": "critical", "discretization": {"accuracy": 1e-9}}
})";

/// Moments about the foot: M(t) = P (sin t + 0.05 cos t) at the rotation t. The limit point is the maximum of
/// P.
double limit_load() {
  double most = 0.0;
  for (int step = 1; step <= 100000; ++step) {
    const double t = 1e-5 * step;
    const double moment = 10.0 * t / std::sqrt(1.0 + 100.0 * t * t);
    most = std::max(most, moment / (std::sin(t) + 0.05 * std::cos(t)));
  }
  return most;
}

TEST(Howto, ARequestWithTheNewLawReachesItsLimitPoint) {
  const api::ReadOutcome outcome = api::read_request(kRequest);
  ASSERT_TRUE(outcome.request.has_value()) << outcome.findings.front().detail;
  const Result result = solve(outcome.request->model, outcome.request->analysis);
  ASSERT_TRUE(result.summary.critical_load_factor.has_value());
  EXPECT_EQ(result.summary.critical_type, CriticalType::limit_max);
  // the steps of t leave 1e-9 of the maximum; bending of the bar leaves P / EI = 5e-11
  EXPECT_NEAR(*result.summary.critical_load_factor / limit_load(), 1.0, 2e-9);
}

}  // namespace
}  // namespace snapthrough
