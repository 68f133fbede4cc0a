/// Modes of critical points: null vectors of the tangent stiffness at the located point, of the state's mesh.
///
/// A mode's residual is J phi over the largest force at the elements' ends in phi. The second derivative of
/// the energy along the mode, phi.J phi, changes its sign where stability is lost. The mode of a pinned arch
/// is antisymmetric, that of its limit point symmetric.
#include "solver/discrete/build_structure.h"
#include "solver/events/critical_mode.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "solver/trace/trace.h"
#include "tests/paths/reference_problems.h"
#include "tests/solver/trace/follow.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// What is measured of each critical point of a path.
struct Measured {
  CriticalEvent event;
  double residual = 0.0;
  double before = 0.0;  ///< phi.J phi at the step's ends
  double after = 0.0;
};

/// Largest component of the forces at elements' ends.
double force_in(const Structure& structure, const Eigen::VectorXd& mode) {
  double force = 0.0;
  for (const ElementDofs& dofs : structure.dofs)
    force = std::max(force, mode.segment<3>(dofs.m).lpNorm<Eigen::Infinity>());
  return force;
}

std::vector<Measured> measure(const Model& model, const Discretization& mesh, int limit_points) {
  const Structure structure = make_structure(resolve(model), mesh, Geometry::nonlinear);
  StructuralProblem problem(structure);
  std::vector<Measured> out;
  std::size_t done = 0;
  TraceRules rules;
  rules.limit_points = limit_points;
  testing::Observed observer;
  PathPoint last;
  std::vector<PathPoint> starts;  // the path's points before the events
  observer.point = [&](const PathPoint& point) { last = point; };
  observer.critical = [&](const CriticalEvent& event) {
    out.push_back({event});
    starts.push_back(last);
  };
  observer.step = [&](const PathPoint&, const PathPoint& to) {
    for (; done < out.size(); ++done) {
      const PathPoint& at = out[done].event.point;
      // a step may end on the point itself
      if (!(to.arc_length > (1.0 + 1e-9) * at.arc_length)) return;
      const Eigen::VectorXd mode = mode_of(problem, out[done].event);
      out[done].residual = problem.tangent_product(at.y, at.lambda, mode).lpNorm<Eigen::Infinity>() /
                           force_in(structure, mode);
      out[done].before = mode.dot(problem.tangent_product(starts[done].y, starts[done].lambda, mode));
      out[done].after = mode.dot(problem.tangent_product(to.y, to.lambda, mode));
    }
  };
  static_cast<void>(testing::follow(problem, rules, {&observer}));
  return out;
}

TEST(CriticalMode, IsANullVectorOfTheTangent) {
  constexpr double kResidual = 1e-6;
  Model braced = arch(20.0, 420.0, 1.4);
  braced.springs = {{"k", at_member("arch", 0.3), std::array{0.3, 1.0}, 1e-4, Reaction::bilateral, 0.0}};
  Model soil = arch(20.0, 420.0, 1.4);
  add_soil(soil, 1e5);
  for (const auto& [name, model] :
       {std::pair{"arch", arch(20.0, 420.0, 1.4)}, std::pair{"braced", braced}, std::pair{"soil", soil},
        std::pair{"deep arch", arch(215.0, 1e8, 1e6, true)}}) {
    const std::vector<Measured> points = measure(model, fixed_mesh(12, 4), 2);
    ASSERT_GE(points.size(), 2u) << name;
    for (const Measured& point : points) EXPECT_LT(point.residual, kResidual) << name;
  }
}

TEST(CriticalMode, LosesItsStiffnessThere) {
  const std::vector<Measured> points = measure(arch(20.0, 420.0, 1.4), fixed_mesh(12, 4), 1);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].event.type, CriticalType::bifurcation);
  EXPECT_GT(points[0].before, 0.0);
  EXPECT_LT(points[0].after, 0.0);
}

/// Of a critical point with its state: how far the mode is from its mirror image times `sign`.
double asymmetry(const Mode& mode, double sign) {
  const MemberMode& m = mode.members.at(0);
  double worst = 0.0;
  for (std::size_t i = 0; i < m.s.size(); ++i) {
    const std::size_t j = m.s.size() - 1 - i;
    worst = std::max({worst, std::abs(m.u[i] + sign * m.u[j]), std::abs(m.v[i] - sign * m.v[j]),
                      std::abs(m.rotation[i] + sign * m.rotation[j])});
  }
  return worst;
}

double largest(const Mode& mode) {
  double size = 0.0;
  for (const MemberMode& m : mode.members)
    for (std::size_t i = 0; i < m.s.size(); ++i) size = std::max(size, std::hypot(m.u[i], m.v[i]));
  return size;
}

/// By default, on fixed meshes, and on the finer meshes that an accuracy asks for.
TEST(CriticalMode, OfThePinnedArchIsAntisymmetricAndSymmetricAtItsLimit) {
  std::vector<Discretization> meshes{{}, fixed_mesh(12, 4), fixed_mesh(8, 3)};
  meshes.emplace_back().accuracy = 1e-8;
  for (const Discretization& mesh : meshes) {
    Analysis analysis = path_on(mesh, 1);
    analysis.output.states = StateOutput::critical;
    const Result result = solve_soundly(arch(20.0, 420.0, 1.4), analysis);
    ASSERT_EQ(result.critical_points.size(), 2u);
    for (const CriticalPoint& point : result.critical_points) {
      ASSERT_TRUE(point.state && point.mode);
      EXPECT_NEAR(largest(*point.mode), 1.0, 1e-12);
      EXPECT_LT(asymmetry(*point.mode, point.type == CriticalType::bifurcation ? -1.0 : 1.0), 1e-9);
    }
  }
}

/// Euler's column with a dead load: the first mode is a half sine wave, with its slope as rotation in the
/// model's own units.
TEST(CriticalMode, OfAColumnIsASine) {
  const double length = 20.0;
  Model model = straight(length, 3.0, 3e7, "xy", "y");
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  Analysis analysis = analysis_of(AnalysisType::critical, {});
  analysis.discretization.accuracy = 1e-8;
  analysis.output.states = StateOutput::critical;
  const Result result = solve_soundly(model, analysis);
  expect_relative(*result.summary.critical_load_factor, 3.0 * kPi * kPi / (length * length), 1e-5, "Euler");
  ASSERT_TRUE(result.critical_points.at(0).mode);
  const MemberMode& m = result.critical_points[0].mode->members.at(0);
  for (std::size_t i = 0; i < m.s.size(); ++i) {
    EXPECT_NEAR(m.v[i], std::sin(kPi * m.s[i] / length), 1e-5);
    EXPECT_NEAR(m.rotation[i], kPi / length * std::cos(kPi * m.s[i] / length), 1e-5);
  }
}

TEST(CriticalMode, IsThereWithTheStateOnly) {
  for (const StateOutput states : {StateOutput::none, StateOutput::critical, StateOutput::all}) {
    Analysis analysis = path_on({}, 1);
    analysis.output.states = states;
    const Result result = solve_soundly(arch(20.0, 420.0, 1.4), analysis);
    ASSERT_EQ(result.critical_points.size(), 2u);
    for (const CriticalPoint& point : result.critical_points) {
      EXPECT_EQ(point.mode.has_value(), states != StateOutput::none);
      EXPECT_EQ(point.state.has_value(), states != StateOutput::none);
      if (!point.state) continue;
      const State& state = result.states.at(static_cast<std::size_t>(*point.state));
      expect_relative(state.load_factor, point.load_factor, 1e-4, "load factor of the state");
    }
  }
}

}  // namespace
}  // namespace snapthrough
