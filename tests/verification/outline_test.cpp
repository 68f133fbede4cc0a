/// Rigid obstacles, and media whose surface is fixed in the plane.
///
/// Sources. Half a ring under its weight in a circular cavity: limit points by collocation of the free
/// boundary problem (data/thesis_4_5_ring_winkler.csv describes the problem; the values for a medium with a
/// true circular surface and for a rigid cavity were computed with the same program).
#include <limits>
#include <optional>
#include <string>

#include "tests/solver/structures.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();

Model ring_in_cavity(double k) {
  Model model = half_ring_in_medium(k, 36e6);
  model.foundations[0].outline = CircleOutline{{0.0, 0.0}, 10.0, false};
  return model;
}

Result critical_to(const Model& model, double accuracy) {
  return solve_soundly(model, analysis_of(AnalysisType::critical, accurate(accuracy)));
}

TEST(RingInACavity, LosesStabilityAtTheLoadsOfCollocation) {
  for (const auto& [k, expected] : {std::pair{1200.0, 14.126938}, {1e6, 77.645944}, {1e8, 81.504968}}) {
    const Result result = critical_to(ring_in_cavity(k), 1e-6);
    ASSERT_TRUE(result.summary.critical_load_factor) << k << ": " << result.summary.message;
    expect_relative(*result.summary.critical_load_factor, expected, 1e-6, "k " + std::to_string(k));
  }
}

TEST(RingInACavity, ReachesTheLoadOfARigidCavity) {
  for (const double accuracy : {1e-3, 1e-4, 1e-5}) {
    const Result result = critical_to(ring_in_cavity(kRigid), accuracy);
    ASSERT_TRUE(result.summary.critical_load_factor) << accuracy << ": " << result.summary.message;
    ASSERT_TRUE(result.summary.error_estimate) << accuracy;
    EXPECT_LE(*result.summary.error_estimate, accuracy);
    expect_relative(*result.summary.critical_load_factor, 81.5574276, *result.summary.error_estimate,
                    "rigid");
  }
}

}  // namespace
}  // namespace snapthrough
