/// Springs between nodes and rods: tangent and its derivative against central differences.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "solver/discrete/build_structure.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "solver/resolve/rods.h"
#include "tests/solver/central_differences.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

Spring between(const std::string& id, const std::string& at, const std::string& to) {
  Spring out;
  out.id = id;
  out.at.node = at;
  out.to = Location{to, "", 0.0};
  out.stiffness = 40.0;
  return out;
}

/// Two beams with an inclined support, springs between their nodes, and a rod of each kind to a node that
/// only rods and a soft spring to ground hold.
Model with_links() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.1}, {"c", 0.4, 0.9}, {"d", 1.2, 1.1}};
  model.sections = {{"s", 300.0, 1.0, {}}};
  model.members = {{"ab", "a", "b", "s", LineCurve{}},
                   {"bc", "b", "c", "s", LineCurve{}},
                   {"push", "c", "d", "s", LineCurve{}},
                   {"pull", "d", "b", "s", LineCurve{}}};
  model.members[2].reaction = Reaction::compression_only;
  model.members[3].reaction = Reaction::tension_only;
  model.supports = {{"a", true, true, false, 0.0, {}}, {"b", false, true, false, 25.0, {}}};
  model.loads = {PointLoad{{"d", "", 0.0}, {0.5, -1.0}, 0.0, Pattern::proportional}};
  Spring along = between("along", "a", "c");
  along.direction = {0.3, 1.0};
  along.law = ReactionLaw{ReactionLaw::Type::tanh, 40.0, 3.0, 0.0, 0.5, {}, {}, 1.0};
  Spring push = between("push", "c", "b");
  push.direction = {1.0, -0.5};
  push.reaction = Reaction::compression_only;
  push.gap = 0.01;
  Spring soft = between("soft", "d", "a");
  soft.to.reset();
  soft.direction = {1.0, 0.0};
  Spring soft_too = soft;
  soft_too.id = "soft too";
  soft_too.direction = {0.2, 1.0};
  model.springs = {along, push, between("turning", "a", "c"), soft, soft_too};
  return *with_rods_as_springs(model);
}

class Links : public ::testing::TestWithParam<Geometry> {
 protected:
  static constexpr double kStep = 1e-6;
  const Structure structure_ = make_structure(resolve(with_links()), testing::fixed_mesh(2, 3), GetParam());
  StructuralProblem problem_{structure_};
};

TEST_P(Links, HaveTheTangentOfTheirForces) {
  std::srand(3u);
  int acting = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const VectorXd y = 0.2 * VectorXd::Random(problem_.size());
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::residual_difference(problem_, y, 0.3, d, kStep);
    EXPECT_LT((problem_.tangent_product(y, 0.3, d) - difference).norm(), 1e-7 * difference.norm()) << draw;
    // the factors are those of the same tangent
    VectorXd f;
    problem_.linearise(y, 0.3, f);
    VectorXd back = problem_.tangent_product(y, 0.3, d);
    problem_.solve(back);
    EXPECT_LT((back - d).head(12).norm(), 1e-8 * d.norm()) << draw;
    for (const NodeSpring& spring : structure_.node_springs)
      if (spring.is_rod() && spring.acts(spring.motion(y, GetParam() == Geometry::linear).w)) ++acting;
  }
  EXPECT_GT(acting, 5);
  EXPECT_LT(acting, 35);
}

TEST_P(Links, HaveTheDerivativeOfTheirTangent) {
  std::srand(7u);
  for (int draw = 0; draw < 20; ++draw) {
    const VectorXd y = 0.2 * VectorXd::Random(problem_.size());
    const VectorXd a = VectorXd::Random(problem_.size());
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::tangent_difference(problem_, y, 0.3, a, d, kStep);
    const VectorXd change = problem_.tangent_change(y, 0.3, {a, 0.0}, d);
    EXPECT_LT((change - difference).norm(), 1e-6 * (1.0 + difference.norm())) << draw;
  }
}

/// The change of a rod's length keeps its digits where displacements are small.
TEST_P(Links, KeepTheDigitsOfSmallDisplacements) {
  for (const NodeSpring& spring : structure_.node_springs) {
    if (!spring.is_rod()) continue;
    VectorXd y = VectorXd::Zero(problem_.size());
    y.segment<3>(3 * spring.node) = 1e-12 * spring.direction();
    EXPECT_NEAR(spring.motion(y, false).w, 1e-12, 1e-24);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Links, ::testing::Values(Geometry::nonlinear, Geometry::linear));

}  // namespace
}  // namespace snapthrough
