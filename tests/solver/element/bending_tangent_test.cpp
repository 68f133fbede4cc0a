/// Tangent and its derivative where sections have bending laws, against central differences and the condensed
/// form.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/element/bending_curve.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/central_differences.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;
using testing::fixed_mesh;

BendingLaw power_law() {
  BendingLaw law;
  law.type = BendingLaw::Type::ramberg_osgood;
  law.moment = 0.3;
  law.exponent = 4.5;
  law.coefficient = 0.7;
  return law;
}

BendingLaw table() {
  BendingLaw law;
  law.points = {{0.2, 0.2}, {0.5, 0.3}, {2.0, 0.6}};
  return law;
}

/// An arch with a bending law, and a straight member beside it without one.
Model arch_with(const BendingLaw& law, bool shears) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}, {"c", 2.0, 0.3}};
  Section section{"s", 1e3, law.type == BendingLaw::Type::table ? initial_slope(law) : 1.0, {}};
  if (shears) section.GA = 50.0;
  model.sections = {section, section};
  model.sections[1].id = "linear";
  model.sections[0].bending = law;
  model.members = {{"arch", "a", "b", "s", ArcCurve{-80.0}, false, false},
                   {"tie", "b", "c", "linear", LineCurve{}, false, false}};
  model.supports = {{"a", true, true, false, 0.0, {}}, {"c", true, true, true, 0.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {0.5, -1.0}, 0.0, Pattern::proportional}};
  return model;
}

struct Case {
  BendingLaw law;
  bool shears;
  Geometry geometry;
};

class BendingTangent : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr double kStep = 1e-6;
  const Structure structure_ = make_structure(resolve(arch_with(GetParam().law, GetParam().shears)),
                                              fixed_mesh(3, 4), GetParam().geometry);
  StructuralProblem problem_{structure_};
};

TEST_P(BendingTangent, IsTheDerivativeOfTheResidual) {
  std::srand(3u);
  for (int draw = 0; draw < 5; ++draw) {
    const VectorXd y = VectorXd::Random(problem_.size());
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::residual_difference(problem_, y, 0.3, d, kStep);
    EXPECT_LT((problem_.tangent_product(y, 0.3, d) - difference).norm(), 1e-8 * difference.norm()) << draw;
  }
}

TEST_P(BendingTangent, ChangesByItsDerivative) {
  std::srand(7u);
  for (int draw = 0; draw < 5; ++draw) {
    const VectorXd y = VectorXd::Random(problem_.size());
    const VectorXd a = VectorXd::Random(problem_.size());
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::tangent_difference(problem_, y, 0.3, a, d, kStep);
    const VectorXd change = problem_.tangent_change(y, 0.3, {a, 0.0}, d);
    EXPECT_LT((change - difference).norm(), 1e-7 * difference.norm()) << draw;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, BendingTangent,
                         ::testing::Values(Case{power_law(), false, Geometry::nonlinear},
                                           Case{power_law(), true, Geometry::nonlinear},
                                           Case{table(), true, Geometry::nonlinear},
                                           Case{table(), false, Geometry::linear}));

/// The curve is odd, has the slope 1 at the origin, and its derivatives are those of its values.
TEST(BendingCurve, HasItsDerivatives) {
  BendingLaw lines = table();
  lines.interpolation = Interpolation::linear;
  for (const BendingLaw& law : {power_law(), table(), lines}) {
    Section section{"s", 1.0, law.type == BendingLaw::Type::table ? initial_slope(law) : 2.0, {}};
    section.bending = law;
    const auto curve = bending_curve_of(section, Scales{2.0, 0.5, 1.0});
    EXPECT_DOUBLE_EQ(curve->at(0.0).slope, 1.0);
    for (const double m : {0.03, 0.1, 0.27, 0.31, 0.5, 0.9}) {
      const auto at = curve->at(m);
      const auto opposite = curve->at(-m);
      EXPECT_EQ(opposite.moment, -at.moment);
      EXPECT_EQ(opposite.slope, at.slope);
      EXPECT_EQ(opposite.second, -at.second);
      constexpr double d = 1e-6;
      const auto ahead = curve->at(m + d);
      const auto behind = curve->at(m - d);
      EXPECT_NEAR((ahead.moment - behind.moment) / (2.0 * d), at.slope, 1e-8 * at.slope) << m;
      EXPECT_NEAR((ahead.slope - behind.slope) / (2.0 * d), at.second, 1e-6 * (1.0 + std::abs(at.second)))
          << m;
    }
  }
}

}  // namespace
}  // namespace snapthrough
