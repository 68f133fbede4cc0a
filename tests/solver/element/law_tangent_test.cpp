/// Tangent and its derivative where supports have laws that are not linear, against central differences.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "solver/discrete/build_structure.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/central_differences.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;
using testing::fixed_mesh;

ReactionLaw law_of_type(ReactionLaw::Type type) {
  ReactionLaw law;
  law.type = type;
  law.stiffness = 90.0;
  law.capacity = AlongMember({{0.0, 2.0}, {0.55, 5.0}, {1.0, 4.0}});
  law.reference = 0.3;
  law.exponent = 0.4;
  law.points = {{0.02, 0.6}, {0.06, 1.5}, {0.2, 2.2}, {0.5, 2.4}};
  return law;
}

/// An arch of length 1.1 with a law under it, beside it and along it, and in springs.
Model with_laws(ReactionLaw::Type type) {
  const std::string id = "arch";
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}};
  model.sections = {{"s", 1e3, 1.0, {}}};
  Member member{id, "a", "b", "s", ArcCurve{-80.0}, false, false};
  model.members = {member};
  model.supports = {{"a", true, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {0.5, -1.0}, 0.0, Pattern::proportional}};
  Foundation both;
  both.id = "both";
  both.member = id;
  both.law = law_of_type(type);
  both.range = {0.0, 0.7};
  Foundation push = both;
  push.id = "push";
  push.range = {0.3, 1.0};
  push.reaction = Reaction::compression_only;
  push.gap = 0.02;
  Foundation along = both;
  along.id = "along";
  along.component = FoundationComponent::tangent;
  push.displacement = GroundDisplacement{AlongMember({{0.0, 0.1}, {0.6, -0.2}}), 0.3, Pattern::proportional};
  along.displacement = GroundDisplacement{-0.1, AlongMember({{0.2, 0.0}, {1.0, 0.4}}), Pattern::constant};
  model.foundations = {both, push, along};
  Spring spring;
  spring.id = "inside";
  spring.at = {"", id, 0.41};
  spring.direction = {0.4, 1.0};
  spring.law = law_of_type(type);
  spring.law->capacity = 3.0;
  spring.displacement = PrescribedDisplacement{0.1, -0.3, 0.0, Pattern::proportional};
  Spring turning = spring;
  turning.displacement = PrescribedDisplacement{0.0, 0.0, 0.2, Pattern::constant};
  turning.id = "turning";
  turning.at = {model.nodes[0].id, "", 0.0};
  turning.direction = std::nullopt;
  model.springs = {spring, turning};
  return model;
}

class LawTangent : public ::testing::TestWithParam<ReactionLaw::Type> {
 protected:
  static constexpr double kStep = 1e-6;
  const Structure structure_ =
      make_structure(resolve(with_laws(GetParam())), fixed_mesh(4, 3), Geometry::nonlinear);
  StructuralProblem problem_{structure_};
};

/// Random unknowns whose displacements are of the size of the laws' knots, so that all branches occur.
VectorXd state_of(const StructuralProblem& problem) { return 0.1 * VectorXd::Random(problem.size()); }

TEST_P(LawTangent, IsTheDerivativeOfTheResidual) {
  std::srand(3u);
  for (int draw = 0; draw < 5; ++draw) {
    const VectorXd y = state_of(problem_);
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::residual_difference(problem_, y, 0.3, d, kStep);
    const VectorXd product = problem_.tangent_product(y, 0.3, d);
    // Quadrature of pieces that move leaves 1e-6 at most. A power has a jump of its slope, whose place is
    // interpolated: on the element in which the capacity bends, that place is right to some digits only.
    const double most = GetParam() == ReactionLaw::Type::tanh    ? 1e-7
                        : GetParam() == ReactionLaw::Type::power ? 2e-3
                                                                 : 2e-6;
    EXPECT_LT((product - difference).norm(), most * difference.norm()) << draw;
  }
}

TEST_P(LawTangent, ChangesByItsDerivative) {
  std::srand(7u);
  for (int draw = 0; draw < 5; ++draw) {
    const VectorXd y = state_of(problem_);
    const VectorXd a = VectorXd::Random(problem_.size());
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::tangent_difference(problem_, y, 0.3, a, d, kStep);
    const VectorXd change = problem_.tangent_change(y, 0.3, {a, 0.0}, d);
    EXPECT_LT((change - difference).norm(), 1e-3 * difference.norm()) << draw;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, LawTangent,
                         ::testing::Values(ReactionLaw::Type::tanh, ReactionLaw::Type::hyperbolic,
                                           ReactionLaw::Type::power, ReactionLaw::Type::table));

}  // namespace
}  // namespace snapthrough
