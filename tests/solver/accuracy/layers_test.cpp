/// How near to where something acts a member's bending changes.
#include "solver/accuracy/layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solver/discrete/build_structure.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/linear_response.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

/// The linear response to an axial force at the end of a column of EI = 2.
double decay_under(double force, const Model& model) {
  const Structure structure = make_structure(resolve(model), testing::fixed_mesh(4, 3), Geometry::nonlinear);
  // the load of the model is one, and presses
  const Eigen::VectorXd y = -force * structure.scales.load * testing::linear_response(structure);
  return bending_decays(structure, y).front();
}

TEST(BendingDecays, AreThoseOfAPulledString) {
  const Model model = testing::column(3.0, 2.0, 1e6, 0.0);
  EXPECT_NEAR(decay_under(8e4, model), 5e-3, 1e-6);
  EXPECT_NEAR(decay_under(8e8, model), 5e-5, 1e-8);
}

TEST(BendingDecays, AreInfiniteWhereAMemberIsPressed) {
  EXPECT_EQ(decay_under(-8e4, testing::column(3.0, 2.0, 1e6, 0.0)), std::numeric_limits<double>::infinity());
}

TEST(BendingDecays, AreThoseOfShearOnABase) {
  Model model = testing::column(3.0, 2.0, 1e6, 1e4);
  model.sections[0].GA = 25.0;
  EXPECT_NEAR(decay_under(0.0, model), 0.05, 1e-9);
}

}  // namespace
}  // namespace snapthrough
