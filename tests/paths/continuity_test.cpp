/// No step of a path leads to another path: halfway between its ends, in the plane across the step, there is
/// an equilibrium where the cubic through both ends and their tangents says. Between two paths it is
/// elsewhere (symmetric ones apart), whatever the angle of a step, its inertia and the length of its chord.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/path/segment.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "solver/trace/trace.h"
#include "tests/paths/reference_problems.h"
#include "tests/solver/trace/follow.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Distance of the equilibrium halfway from the cubic there, over the chord; infinite where there is none.
/// Chords that are shorter than rounding leaves singular points apart are counted as that long.
double off_halfway(PointSolver& probe, const PathPoint& from, const PathPoint& to) {
  const Segment step(probe, from, to);
  const auto middle = step.point_at(0.5);
  if (!middle) return std::numeric_limits<double>::infinity();
  PathPoint guess;
  step.interpolate(0.5, guess);
  constexpr double kSingular = 1e-5;
  return probe.norm().distance(guess, *middle) / std::max(probe.norm().distance(from, to), kSingular);
}

/// The largest of the path to the first limit point or load that the problem asks for; points are appended.
double largest_off_halfway(const ReferenceProblem& problem, std::vector<PathPoint>& points) {
  const Structure structure = make_structure(resolve(problem.model), {}, Geometry::nonlinear);
  StructuralProblem equations(structure);
  PathFollower path(equations);
  PointSolver probe(equations, {});
  TraceRules rules;
  rules.limit_points = problem.analysis.stop.limit_points;
  if (problem.analysis.stop.load_factor) {
    const auto& range = *problem.analysis.stop.load_factor;
    rules.load = {{range[0] * structure.scales.load, range[1] * structure.scales.load}};
  }
  rules.steps = 60;
  double largest = 0.0;
  Observed observer;
  observer.step = [&](const PathPoint& from, const PathPoint& to) {
    probe.norm().adopt(path.norm());
    largest = std::max(largest, off_halfway(probe, from, to));
    points.push_back(to);
  };
  static_cast<void>(trace(path, find_start(path.solver()).point, rules, {}, {&observer}, {}));
  return largest;
}

/// A cubic that turns by 0.9 rad, at which steps are rejected, is 0.9 / 8 of its chord off the chord at most:
/// no smooth step can be twice as far off its own cubic.
constexpr double kSmooth = 0.2;

TEST(Continuity, EveryStepHasAnEquilibriumHalfway) {
  for (const ReferenceProblem& problem : benchmark_problems()) {
    std::vector<PathPoint> points;
    EXPECT_LT(largest_off_halfway(problem, points), kSmooth) << problem.name;
    EXPECT_GE(points.size(), 1u) << problem.name;
  }
}

/// From an arch before its limit point to the same arch, snapped through, under about the same load.
TEST(Continuity, AJumpHasItElsewhere) {
  ReferenceProblem arch = shallow_arch(0.0, Side::left, std::nullopt);
  arch.analysis.stop.limit_points.reset();
  std::vector<PathPoint> points;
  EXPECT_LT(largest_off_halfway(arch, points), kSmooth);
  const auto turned =
      std::find_if(points.begin(), points.end(), [](const PathPoint& at) { return at.tangent_lambda < 0.0; });
  const auto snapped = std::find_if(
      turned, points.end(), [](const PathPoint& at) { return at.tangent_lambda > 0.0 && at.lambda > 0.0; });
  ASSERT_NE(snapped, points.end());
  const Structure structure = make_structure(resolve(arch.model), {}, Geometry::nonlinear);
  StructuralProblem equations(structure);
  PointSolver probe(equations, {});
  ASSERT_TRUE(find_start(probe));
  EXPECT_GT(off_halfway(probe, points.front(), *snapped), 2.0 * kSmooth);
}

}  // namespace
}  // namespace snapthrough
