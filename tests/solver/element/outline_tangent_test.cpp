/// Tangent and its derivative where a medium has a surface in the plane, or a gap that varies along the
/// member, against central differences.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/discrete/element_reader.h"
#include "solver/discrete/foundation_springs.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/central_differences.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;
using testing::fixed_mesh;

/// An arch of length 1.1 above a medium.
Model beside(const Foundation& medium) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}};
  model.sections = {{"s", 1e3, 1.0, {}}};
  model.members = {{"arch", "a", "b", "s", ArcCurve{-80.0}, false, false}};
  model.supports = {{"a", true, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {0.5, -1.0}, 0.0, Pattern::proportional}};
  model.foundations = {medium};
  return model;
}

Foundation medium_of(const Outline& outline) {
  Foundation out;
  out.id = "medium";
  out.member = "arch";
  out.stiffness = 90.0;
  out.reaction = Reaction::compression_only;
  out.outline = outline;
  return out;
}

std::vector<std::pair<std::string, Foundation>> media() {
  std::vector<std::pair<std::string, Foundation>> out;
  const std::vector<std::array<double, 2>> hill{{-0.5, 0.1}, {0.2, 0.2}, {0.6, 0.12}, {1.5, 0.2}};
  out.emplace_back("cavity", medium_of(CircleOutline{{0.5, -0.4}, 0.62, false}));
  out.emplace_back("bar", medium_of(CircleOutline{{0.5, -0.4}, 0.55, true}));
  out.emplace_back("floor", medium_of(LineOutline{{0.0, 0.12}, {0.1, -1.0}}));
  out.emplace_back("hill", medium_of(SplineOutline{hill, Side::right}));
  out.emplace_back("roof", medium_of(PolylineOutline{hill, 0.6, Side::right}));
  out.emplace_back("yielding", medium_of(CircleOutline{{0.5, -0.4}, 0.62, false}));
  ReactionLaw law;
  law.type = ReactionLaw::Type::tanh;
  law.stiffness = 90.0;
  law.capacity = 3.0;
  out.back().second.law = law;
  out.emplace_back("yielding_on_moving_ground", out.back().second);
  out.back().second.displacement =
      GroundDisplacement{AlongMember({{0.1, 0.1}, {0.5, -0.1}}), 0.05, Pattern::proportional};
  Foundation gaps = medium_of(CircleOutline{});
  gaps.outline.reset();
  gaps.gap_along = {{0.0, 0.0}, {0.25, 0.05}, {1.0, 0.01}};
  out.emplace_back("gaps", gaps);
  return out;
}

class OutlineTangent : public ::testing::TestWithParam<std::pair<std::string, Foundation>> {
 protected:
  static constexpr double kStep = 1e-6;
  const Structure structure_ =
      make_structure(resolve(beside(GetParam().second)), fixed_mesh(4, 3), Geometry::nonlinear);
  StructuralProblem problem_{structure_};
};

/// Random unknowns of the size of the distances to the media.
VectorXd state_of(const StructuralProblem& problem) { return 0.1 * VectorXd::Random(problem.size()); }

/// Sum of the forces along x or y (component 0 or 1) in a residual of one member.
double force_along(const Structure& structure, const VectorXd& residual, int component) {
  double sum = residual[structure.dofs.back().b[component]];
  for (const ElementDofs& dofs : structure.dofs) sum += residual[dofs.a[component]];
  return sum;
}

/// The quadrature splits where contact ends and where a derivative of the depth jumps; the midpoint rule on
/// many points needs no such splits.
TEST_P(OutlineTangent, BelongsToTheIntegralOfTheReaction) {
  constexpr int kPoints = 4000;
  Model model = beside(GetParam().second);
  model.supports.clear();
  const Structure medium = make_structure(resolve(model), fixed_mesh(4, 3), Geometry::nonlinear);
  model.foundations[0].law.reset();
  model.foundations[0].stiffness = 0.0;
  const Structure none = make_structure(resolve(model), fixed_mesh(4, 3), Geometry::nonlinear);
  StructuralProblem with_medium(medium);
  StructuralProblem without(none);
  std::srand(5u);
  for (int draw = 0; draw < 5; ++draw) {
    const VectorXd y = state_of(with_medium);
    VectorXd f;
    VectorXd rest;
    with_medium.residual(y, 0.0, f);
    without.residual(y, 0.0, rest);
    double expected[2] = {0.0, 0.0};
    for (int e = 0; e < 4; ++e) {
      const FoundationLaw law = law_on(medium, medium.foundation_laws[0], e);
      const ElementReader reader(medium, y, e, law);
      for (int i = 0; i < kPoints; ++i) {
        const double xi = (i + 0.5) / kPoints;
        const PlaceOnAxis at = place_on_axis(medium, e, xi);
        const auto u = reader.displacement(xi);
        const SurfacePoint point = law.penetration(at, {u[0], u[1]});
        const double force = law.at(at.fraction).reaction_beyond(point.depth) * reader.length() / kPoints;
        for (int c = 0; c < 2; ++c) expected[c] += force * point.into[c];
      }
    }
    const double size = std::hypot(expected[0], expected[1]);
    for (int c = 0; c < 2; ++c)
      EXPECT_NEAR(force_along(medium, f - rest, c), expected[c], 1e-6 * size) << draw << " " << c;
  }
}

TEST_P(OutlineTangent, IsTheDerivativeOfTheResidual) {
  std::srand(3u);
  for (int draw = 0; draw < 5; ++draw) {
    const VectorXd y = state_of(problem_);
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::residual_difference(problem_, y, 0.3, d, kStep);
    const VectorXd product = problem_.tangent_product(y, 0.3, d);
    // quadrature of pieces that move leaves 1e-6 at most
    EXPECT_LT((product - difference).norm(), 2e-6 * difference.norm()) << draw;
  }
}

/// The factorised tangent is the tangent of the products.
TEST_P(OutlineTangent, IsTheOneThatIsFactorised) {
  std::srand(5u);
  const VectorXd y = state_of(problem_);
  VectorXd f;
  problem_.linearise(y, 0.3, f);
  VectorXd x = VectorXd::Random(problem_.size());
  const VectorXd right = x;
  problem_.solve(x);
  EXPECT_LT((problem_.tangent_product(y, 0.3, x) - right).norm(), 1e-9 * right.norm());
}

TEST_P(OutlineTangent, ChangesByItsDerivative) {
  std::srand(7u);
  for (int draw = 0; draw < 5; ++draw) {
    const VectorXd y = state_of(problem_);
    const VectorXd a = VectorXd::Random(problem_.size());
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::tangent_difference(problem_, y, 0.3, a, d, kStep);
    const VectorXd change = problem_.tangent_change(y, 0.3, {a, 0.0}, d);
    EXPECT_LT((change - difference).norm(), 1e-4 * difference.norm()) << draw;
  }
}

INSTANTIATE_TEST_SUITE_P(Media, OutlineTangent, ::testing::ValuesIn(media()),
                         [](const auto& one) { return one.param.first; });

}  // namespace
}  // namespace snapthrough
