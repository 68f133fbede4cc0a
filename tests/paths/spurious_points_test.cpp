/// No false limit points: their number does not depend on mesh, order or base quadrature.
///
/// Source: spurious_limit_points.csv (215-degree arch, clamped and hinged, outside base, EA R^2 / EI = 1.2e5,
/// crown drop 0.05 to 1.3 R): the free-boundary path has exactly one extremum, at 12.5617 for k = 1e3
/// and 19.4846 for k = 1e4; springs at points give up to 29.
#include "tests/paths/reference_problems.h"

namespace snapthrough {
namespace {

using namespace testing;

TEST(SpuriousLimitPoints, DoNotExistWhateverTheMesh) {
  const struct { double k, limit; } cases[] = {{1e3, 12.561736}, {1e4, 19.484637}};
  const struct {
    int elements, order;
    double tolerance;
  } meshes[] = {{60, 1, 7.3e-2}, {40, 2, 1e-3}, {24, 3, 1e-3}, {12, 4, 1e-3},
                {40, 4, 1e-6},   {16, 6, 1e-4}, {12, 8, 1e-4}};
  for (const auto& c : cases) {
    for (const auto& mesh : meshes) {
      ReferenceProblem p = deep_arch(215.0, c.k, c.limit);
      p.analysis.discretization = fixed_mesh(mesh.elements, mesh.order);
      p.analysis.stop.limit_points.reset();
      p.analysis.stop.monitor = MonitorRange{"crown", {-130.0, 130.0}};
      const Result result = solve_soundly(p.model, p.analysis);
      const std::string at = "k " + std::to_string(c.k) + ", " + std::to_string(mesh.elements) +
                             " elements of order " + std::to_string(mesh.order);
      EXPECT_EQ(result.summary.termination, "monitor") << at;
      const auto limits = limits_of(result);
      ASSERT_EQ(limits.size(), 1u) << at;
      EXPECT_EQ(limits[0].type, CriticalType::limit_max) << at;
      expect_relative(limits[0].load_factor, c.limit, mesh.tolerance, at);
    }
  }
}

}  // namespace
}  // namespace snapthrough
