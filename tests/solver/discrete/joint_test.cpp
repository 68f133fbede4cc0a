/// Joints with laws at released member ends: tangent and its derivative against central differences, scales.
#include <gtest/gtest.h>

#include <cstdlib>

#include "solver/discrete/build_structure.h"
#include "solver/mesh/dof_map.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/central_differences.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;
using Type = ReactionLaw::Type;

/// Three beams from a clamp to an inclined support; joints of every law, one linear joint and a hinge.
Model with_joints() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.1}, {"c", 1.4, 0.9}, {"d", 2.2, 1.1}};
  model.sections = {{"s", 300.0, 1.0, {}}};
  model.members = {{"ab", "a", "b", "s", LineCurve{}, true, true},
                   {"bc", "b", "c", "s", LineCurve{}, true, true},
                   {"cd", "c", "d", "s", LineCurve{}, true, true}};
  model.members[0].release_start_law = ReactionLaw{Type::tanh, 40.0, 3.0, 0.0, 0.5, {}, {}, 1.0};
  model.members[0].release_end_law = ReactionLaw{Type::hyperbolic, 20.0, 5.0, 0.0, 0.5, {}, {}, 1.0};
  model.members[1].release_start_law = ReactionLaw{Type::power, 60.0, 4.0, 0.3, 0.4, {}, {}, 1.0};
  model.members[1].release_end_law =
      ReactionLaw{Type::table, 0.0, 0.0, 0.0, 0.5, {{0.1, 2.0}, {0.3, 0.5}}, {}, 2.0};
  model.members[2].release_start_stiffness = 8.0;
  model.supports = {{"a", true, true, true, 0.0, {}}, {"d", false, true, false, 25.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {0.5, -1.0}, 0.0, Pattern::proportional}};
  return model;
}

class Joints : public ::testing::TestWithParam<Geometry> {
 protected:
  static constexpr double kStep = 1e-6;
  const Structure structure_ = make_structure(resolve(with_joints()), testing::fixed_mesh(2, 3), GetParam());
  StructuralProblem problem_{structure_};
};

TEST_P(Joints, AreMadeOfLawsAndOfStiffnesses) {
  ASSERT_EQ(structure_.joints.size(), 5u) << "the end of cd is a hinge";
  EXPECT_EQ(structure_.releases, 6);
  EXPECT_EQ(structure_.curves.size(), 4u);
  EXPECT_TRUE(structure_.traits.has_curves);
  const JointSpring& last = structure_.joints.back();
  EXPECT_EQ(last.member, 2);
  EXPECT_FALSE(last.at_end);
  EXPECT_EQ(last.law.curve, nullptr);
}

TEST_P(Joints, HaveTheTangentOfTheirMoments) {
  std::srand(3u);
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
    EXPECT_LT((back - d).head(structure_.before_elements()).norm(), 1e-8 * d.norm()) << draw;
  }
}

TEST_P(Joints, HaveTheDerivativeOfTheirTangent) {
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

/// Linearised at a state, a joint has there the slope of its law, through the origin.
TEST_P(Joints, AreLinearisedThroughTheOrigin) {
  VectorXd at = VectorXd::Zero(problem_.size());
  for (const JointSpring& joint : structure_.joints) at[joint.node_rotation] = 0.05;
  FrozenContact frozen = problem_.contact().frozen(at, true);
  frozen.linearised_at = at;
  Regime regime;
  regime.contact = Regime::Contact::frozen;
  regime.frozen = &frozen;
  JointWork work(structure_.joints);
  const VectorXd y = 3.0 * at;
  work.evaluate(y, regime);
  VectorXd moments = VectorXd::Zero(problem_.size());
  work.add_moments(moments);
  VectorXd expected = VectorXd::Zero(problem_.size());
  for (std::size_t i = 0; i < structure_.joints.size(); ++i) {
    const Law& law = structure_.joints[i].law;
    const double w = structure_.joints[i].rotation(at);
    const double slope = (law.force_at(w + kStep) - law.force_at(w - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(work.stiffness(i), slope, 1e-6 * (1.0 + std::abs(slope))) << i;
    structure_.joints[i].add(work.stiffness(i) * 3.0 * w, expected);
  }
  EXPECT_LT((moments - expected).norm(), 1e-12 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Both, Joints, ::testing::Values(Geometry::nonlinear, Geometry::linear));

}  // namespace
}  // namespace snapthrough
